// SPDX-License-Identifier: Apache-2.0
/// matc: compiles one material definition (.mat) into a package (.fmat). Flags as in the materials guide, 5.2.
///   Out     the same bytes for any number of threads. Nothing is written if there is an error.
///   Status  0: written; 1: the reason is on standard error, as the guide shows it (5.1): "ERROR: file:line: reason"
///           with the line of the author's file, and which material was not compiled.
#include "base/Suggest.h"
#include "jobsystem/JobSystem.h"
#include "shaders/compiler/Cost.h"
#include "shaders/compiler/MaterialCompiler.h"
#include "shaders/compiler/MaterialDefinition.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace filament;

struct Arguments {
    std::string input, output;
    std::string api = "all";
    std::string reflect;
    std::string platform = "all";
    std::vector<std::string> filters;
    int threads = 0;
    bool optimizeSize = false, noOptimization = false, inexact = false, preprocess = false, cost = false;
};

std::optional<std::string> readFile(std::filesystem::path const& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(file), {});
}

Result<uint16_t> filteredBits(std::vector<std::string> const& filters) {
    uint16_t bits = 0;
    for (std::string const& filter : filters) {
        const std::optional<uint16_t> known = shader::variantBitsOfFilter(filter);
        if (!known) {
            return fail(ErrorCode::InvalidArgument, "there is no variant '{}'{}", filter,
                        suggestion(filter, shader::variantFilterNames()));
        }
        bits |= *known;
    }
    return bits;
}

Result<void> write(std::string const& path, std::vector<std::byte> const& bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (file) return {};
    return fail(ErrorCode::Unreadable, "cannot write '{}'; does its folder exist?", path);
}

Result<void> print(Result<std::string> const& text) {
    if (!text) return text.error();
    std::fputs(text->c_str(), stdout);
    return {};
}

Result<void> run(Arguments const& arguments) {
    const std::optional<std::string> text = readFile(arguments.input);
    if (!text) return fail(ErrorCode::NotFound, "cannot read '{}'", arguments.input);
    const Result<uint16_t> filtered = filteredBits(arguments.filters);
    if (!filtered) return filtered.error();

    jobs::JobSystem jobs({ .workers = arguments.threads > 0 ? arguments.threads - 1 : -1 });
    shader::CompileOptions options{ .exact = !arguments.inexact, .filteredVariants = *filtered, .jobs = &jobs };
    if (arguments.platform == "mobile") options.platform = shader::Platform::Mobile;
    if (arguments.platform == "desktop") options.platform = shader::Platform::Desktop;
    options.spirv = arguments.api != "opengl";
    options.essl = arguments.api != "vulkan";
    if (arguments.optimizeSize) options.optimization = shader::Optimization::Size;
    if (arguments.noOptimization) options.optimization = shader::Optimization::None;
    const std::filesystem::path folder = std::filesystem::path(arguments.input).parent_path();
    options.includes = [&](std::string_view path) { return readFile(folder / path); };

    if (arguments.preprocess) return print(shader::preprocessMaterial(*text, arguments.input, options));
    if (arguments.cost) return print(shader::costReport(*text, arguments.input, options));
    if (!arguments.reflect.empty()) return print(shader::reflectParameters(*text, arguments.input, options));
    const Result<shader::MaterialPackage> package = shader::compileMaterial(*text, arguments.input, options);
    if (!package) return package.error();
    return write(arguments.output, shader::writePackage(*package));
}

} // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app{ "Compiles a material definition (.mat) into a material package (.fmat)." };
    app.add_option("input", arguments.input, "the material definition")->required();
    auto* const output = app.add_option("-o,--output", arguments.output, "the package to write");
    app.add_option("-a,--api", arguments.api, "languages in the package")
            ->check(CLI::IsMember({ "opengl", "vulkan", "all" }));
    app.add_option("-p,--platform", arguments.platform,
                   "platform whose defaults for quality and occlusion apply (one package runs on all)")
            ->check(CLI::IsMember({ "desktop", "mobile", "all" }));
    app.add_option("-v,--variant-filter", arguments.filters, "variants to leave out, separated by commas")
            ->delimiter(',');
    app.add_option("-j,--jobs", arguments.threads, "threads; the output does not depend on it (default: all cores)")
            ->check(CLI::Range(1, 256));
    app.add_flag("-S,--optimize-size", arguments.optimizeSize, "small shaders rather than fast ones");
    app.add_flag("-g,--no-optimization", arguments.noOptimization, "shaders as written, for debugging");
    app.add_flag("--inexact", arguments.inexact,
                 "leave dot, normalize, mix, ... to the drivers; the bits may then differ between APIs");
    auto* const preprocess = app.add_flag("--preprocess", arguments.preprocess, "print the generated GLSL and stop");
    auto* const reflect = app.add_option("-r,--reflect", arguments.reflect, "print what the material declares, as JSON")
                                  ->check(CLI::IsMember({ "parameters" }));
    auto* const cost = app.add_flag("--cost", arguments.cost, "print the operations of the fragment stages and stop");
    CLI11_PARSE(app, argc, argv);
    if (output->empty() && preprocess->empty() && reflect->empty() && cost->empty()) {
        std::fprintf(stderr, "matc: give the package to write with -o\n");
        return 1;
    }
    const Result<void> done = run(arguments);
    if (!done) {
        std::fprintf(stderr, "ERROR: %s\n\nCould not compile material %s\n", done.error().message.c_str(),
                     arguments.input.c_str());
    }
    return done ? 0 : 1;
}
