// SPDX-License-Identifier: Apache-2.0
/// matc: compiles one material definition (.mat) into a package (.fmat). Flags as in the materials guide, 5.2.
///   Out     the same bytes for any number of threads. If there is an error, also a full disk, nothing is written: an
///           old package stays as it was.
///   In      the material, and #include files of its folder (--allow-outside: of any), 1 MiB together.
///   Status  0: written; 1: the reason is on standard error, as the guide shows it (5.1): "ERROR: file:line: reason"
///           with the line of the author's file, and which material was not compiled.
#include "base/Suggest.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/files/PathInside.h"
#include "jobsystem/JobSystem.h"
#include "shaders/compiler/Cost.h"
#include "shaders/compiler/MaterialCompiler.h"
#include "shaders/compiler/MaterialDefinition.h"
#include "tools/common/StandardOutput.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <filesystem>
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
    assets::FilesFrom includes = assets::FilesFrom::Folder;
};

constexpr size_t kMaxTextBytes = 1 << 20; // as the compiler's limit for a material with its includes

/// Files beside the material; see --allow-outside.
std::optional<std::string> readInclude(Arguments const& arguments, std::string_view path) {
    const std::filesystem::path folder = std::filesystem::path(arguments.input).parent_path();
    const Result<std::filesystem::path> file = assets::fileInside(folder, path, arguments.includes);
    if (!file) return std::nullopt;
    Result<std::string> text = assets::readText(*file, kMaxTextBytes);
    return text ? std::optional(std::move(*text)) : std::nullopt;
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

Result<void> write(std::filesystem::path const& path, std::vector<std::byte> const& bytes) {
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    if (!std::filesystem::is_directory(folder)) // replaceFile() would make one, whose name may be a typing error
        return fail(ErrorCode::Unreadable, "cannot write '{}'; does its folder exist?", path.string());
    return assets::replaceFile(path, bytes);
}

Result<void> print(Result<std::string> const& text) {
    if (!text) return text.error();
    return tools::printText(*text);
}

Result<void> run(Arguments const& arguments) {
    const Result<std::string> text = assets::readText(arguments.input, kMaxTextBytes);
    if (!text) return text.error();
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
    options.includes = [&](std::string_view path) { return readInclude(arguments, path); };

    if (arguments.preprocess) return print(shader::preprocessMaterial(*text, arguments.input, options));
    if (arguments.cost) return print(shader::costReport(*text, arguments.input, options));
    if (!arguments.reflect.empty()) return print(shader::reflectParameters(*text, arguments.input, options));
    const Result<shader::MaterialPackage> package = shader::compileMaterial(*text, arguments.input, options);
    if (!package) return package.error();
    return write(arguments.output, shader::writePackage(*package));
}

Result<void> guarded(Arguments const& arguments) {
    try {
        return run(arguments);
    } catch (std::exception const& error) {
        return fail(ErrorCode::OutOfMemory, "{}: out of resources ({}); try a smaller material, or -j 1",
                    arguments.input, error.what());
    }
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
    app.add_flag_callback(
            "--allow-outside", [&] { arguments.includes = assets::FilesFrom::Anywhere; },
            "#include files outside of the material's folder too: absolute paths, \"..\", links that lead out");
    auto* const preprocess = app.add_flag("--preprocess", arguments.preprocess, "print the generated GLSL and stop");
    auto* const reflect = app.add_option("-r,--reflect", arguments.reflect, "print what the material declares, as JSON")
                                  ->check(CLI::IsMember({ "parameters" }));
    auto* const cost = app.add_flag("--cost", arguments.cost, "print the operations of the fragment stages and stop");
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& problem) {
        const int status = app.exit(problem);
        return tools::finishOutput() ? status : 1;
    }
    if (output->empty() && preprocess->empty() && reflect->empty() && cost->empty()) {
        std::fprintf(stderr, "matc: give the package to write with -o\n");
        return 1;
    }
    const Result<void> done = guarded(arguments);
    if (!done) {
        std::fprintf(stderr, "ERROR: %s\n\nCould not compile material %s\n", done.error().message.c_str(),
                     arguments.input.c_str());
    }
    return done ? 0 : 1;
}
