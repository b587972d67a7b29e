// SPDX-License-Identifier: Apache-2.0
#include "tools/matc/Options.h"

#include "shaders/package/PackageFormat.h"
#include "tools/common/StandardOutput.h"

#include <filament/Version.h>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <set>

namespace filament::matc {
namespace {

constexpr const char* kEpilogue = "Exit status: 0 written or printed; 1 the material, one of its files or the output "
                                  "is at fault, and nothing was "
                                  "written; 2 the command line is at fault.";

bool isIdentifier(std::string_view name) {
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0) return false;
    for (const char c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') return false;
    }
    return true;
}

/// "NAME=VALUE"; NAME alone has the value 1, as for C compilers.
std::pair<std::string, std::string> nameAndValue(std::string const& text) {
    const size_t equals = text.find('=');
    std::string name = text.substr(0, equals);
    if (!isIdentifier(name)) throw CLI::ValidationError("'" + text + "' is not of the form NAME=VALUE");
    return { std::move(name), equals == std::string::npos ? "1" : text.substr(equals + 1) };
}

void addOutputs(CLI::App& app, Options& options, bool& writesDependencies) {
    app.add_option("-o,--output", options.output,
                   "the package to write; ends with / : the folder for the packages of all materials, NAME.fmat for "
                   "NAME.mat");
    app.add_flag("-E,--preprocess", options.preprocess, "print the generated GLSL and stop");
    app.add_option("-r,--reflect", options.reflect, "print what the material declares, as JSON")
            ->check(CLI::IsMember({ "parameters" }));
    app.add_flag("--cost", options.cost, "print the operations of the fragment stages and stop");
    app.add_flag("-M,--print-dependencies", options.printDependencies,
                 "print a rule for make that names the files of the material, and stop");
    app.add_flag("--write-dependencies", writesDependencies,
                 "-MD: beside the package, write this rule into a file whose name has .d added");
    app.add_option("--dependency-file", options.dependencyFile, "-MF FILE: write this rule into FILE");
}

void addCompilation(CLI::App& app, Options& options) {
    app.add_option("-a,--api", options.api, "languages in the package")
            ->check(CLI::IsMember({ "opengl", "vulkan", "all" }));
    app.add_option("-p,--platform", options.platform,
                   "platform whose defaults for quality and occlusion apply (one package runs on all)")
            ->check(CLI::IsMember({ "desktop", "mobile", "all" }));
    app.add_option("-v,--variant-filter", options.filters, "variants to leave out, separated by commas")
            ->delimiter(',');
    app.add_option("-j,--jobs", options.threads, "threads; the output does not depend on it (default: all cores)")
            ->check(CLI::Range(1, 256));
    app.add_flag("-S,--optimize-size", options.optimizeSize, "small shaders rather than fast ones");
    app.add_flag("-g,--no-optimization", options.noOptimization, "shaders as written, for debugging");
    app.add_flag("--inexact", options.inexact,
                 "leave dot, normalize, mix, ... to the drivers; the bits may then differ between APIs");
    app.add_flag_callback(
            "--allow-outside", [&] { options.includes = assets::FilesFrom::Anywhere; },
            "#include files outside of the material's folder too: absolute paths, \"..\", links that lead out");
    app.add_flag_callback(
            "-w,--no-warnings", [&] { options.warn = false; }, "print no warnings");
}

void addDefinitions(CLI::App& app, Options& options) {
    app.add_option_function<std::vector<std::string>>(
               "-D,--define",
               [&](std::vector<std::string> const& all) {
                   for (std::string const& each : all) options.defines.push_back(nameAndValue(each));
               },
               "NAME=VALUE: a macro in both blocks, also for #if")
            ->allow_extra_args(false);
    app.add_option_function<std::vector<std::string>>(
               "-T,--template",
               [&](std::vector<std::string> const& all) {
                   for (std::string const& each : all) options.templates.insert(nameAndValue(each));
               },
               "NAME=VALUE: replaces ${NAME} everywhere in the text")
            ->allow_extra_args(false);
}

/// The names of C compilers, which CLI11 would take for groups of one-letter flags.
std::vector<std::string> arguments(int argc, char** argv) {
    std::vector<std::string> reversed;
    for (int i = argc - 1; i > 0; --i) {
        const std::string_view given = argv[i];
        reversed.emplace_back(given == "-MD"                   ? "--write-dependencies"
                              : given == "-MF"                 ? "--dependency-file"
                              : given == "--preprocessor-only" ? "--preprocess"
                                                               : given);
    }
    return reversed;
}

int ended(CLI::App const& app, CLI::ParseError const& problem) {
    const int status = app.exit(problem);
    if (!tools::finishOutput()) return kFailed;
    return status == 0 ? kDone : kUsage;
}

bool namesFolder(std::string const& output) { return output.ends_with('/'); }

/// Empty: the options make sense together.
std::string contradiction(Options const& options, std::vector<std::string> const& inputs) {
    const bool prints = options.preprocess || options.cost || options.printDependencies || !options.reflect.empty();
    if (options.output.empty() && !prints) return "give the package to write with -o";
    if (inputs.size() > 1 && (prints || !namesFolder(options.output)))
        return "several materials need a folder for their packages: give -o FOLDER/, and nothing to print";
    if (namesFolder(options.output) && !options.dependencyFile.empty())
        return "-MF names one file, and -o a folder of packages: use -MD";
    if (namesFolder(options.output) && std::ranges::count(inputs, "-") > 0)
        return "the standard input has no name for a package in a folder: give -o PACKAGE";
    std::set<std::string> packages;
    for (std::string const& input : inputs) {
        if (!packages.insert(std::filesystem::path(input).stem()).second)
            return fmt::format("two materials would write one package: rename one '{}'", input);
    }
    return {};
}

/// The options of one material among all.
Options ofMaterial(Options options, std::string const& input, bool writesDependencies) {
    options.input = input;
    if (namesFolder(options.output)) options.output += std::filesystem::path(input).stem().string() + ".fmat";
    if (writesDependencies && options.dependencyFile.empty()) options.dependencyFile = options.output + ".d";
    return options;
}

} // namespace

Parsed parseOptions(int argc, char** argv) {
    Options options;
    std::vector<std::string> inputs;
    bool writesDependencies = false;
    CLI::App app{ "Compiles a material definition (.mat) into a material package (.fmat)." };
    app.footer(kEpilogue);
    app.set_version_flag("--version", fmt::format("matc of filament_core {}, package format {}", versionText(),
                                                  shader::format::kVersion));
    app.add_option("input", inputs, "the material definitions; - reads one from the standard input")->required();
    addOutputs(app, options, writesDependencies);
    addCompilation(app, options);
    addDefinitions(app, options);
    try {
        app.parse(arguments(argc, argv));
    } catch (CLI::ParseError const& problem) {
        return { {}, ended(app, problem) };
    }
    if (const std::string problem = contradiction(options, inputs); !problem.empty()) {
        std::fprintf(stderr, "matc: %s\n", problem.c_str());
        return { {}, kUsage };
    }
    Parsed parsed;
    for (std::string const& input : inputs) parsed.materials.push_back(ofMaterial(options, input, writesDependencies));
    return parsed;
}

} // namespace filament::matc
