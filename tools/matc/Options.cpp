// SPDX-License-Identifier: Apache-2.0
#include "tools/matc/Options.h"

#include "shaders/package/PackageFormat.h"
#include "toolkit/program/CommandLine.h"
#include "toolkit/program/StandardOutput.h"

#include <filament_core/Version.h>

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>

namespace filament_core::matc {
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

/// "NAME=VALUE"; NAME alone has the value 1, as for C compilers. Nothing: the name is none.
std::optional<std::pair<std::string, std::string>> nameAndValue(std::string const& text) {
    const size_t equals = text.find('=');
    std::string name = text.substr(0, equals);
    if (!isIdentifier(name)) return std::nullopt;
    return std::pair{ std::move(name), equals == std::string::npos ? "1" : text.substr(equals + 1) };
}

/// What becomes members of Options by a conversion.
struct Words {
    std::vector<std::string> defines, templates;
    bool writesDependencies = false, allowsOutside = false, isQuiet = false;
};

void addOutputs(tools::CommandLine& app, Options& options, Words& words) {
    app.option(
            "-o,--output", options.output,
            "the package to write; ends with / : the folder for the packages of all materials, NAME.fmat for NAME.mat");
    app.flag("-E,--preprocess", options.preprocess, "print the generated GLSL and stop");
    app.option("-r,--reflect", options.reflect, "print what the material declares, as JSON").oneOf({ "parameters" });
    app.flag("--cost", options.cost, "print the operations of the fragment stages and stop");
    app.flag("-M,--print-dependencies", options.printDependencies,
             "print a rule for make that names the files of the material, and stop");
    app.flag("--write-dependencies", words.writesDependencies,
             "-MD: beside the package, write this rule into a file whose name has .d added");
    app.option("--dependency-file", options.dependencyFile, "-MF FILE: write this rule into FILE");
}

void addCompilation(tools::CommandLine& app, Options& options, Words& words) {
    app.option("-a,--api", options.api, "languages in the package").oneOf({ "opengl", "vulkan", "all" });
    app.option("-p,--platform", options.platform,
               "platform whose defaults for quality and occlusion apply (one package runs on all)")
            .oneOf({ "desktop", "mobile", "all" });
    app.option("-v,--variant-filter", options.filters, "variants to leave out, separated by commas").separatedBy(',');
    app.option("-j,--jobs", options.threads, "threads; the output does not depend on it (default: all cores)")
            .inRange(1, 256);
    app.flag("-S,--optimize-size", options.optimizeSize, "small shaders rather than fast ones");
    app.flag("-g,--no-optimization", options.noOptimization, "shaders as written, for debugging");
    app.flag("--inexact", options.inexact,
             "leave dot, normalize, mix, ... to the drivers; the bits may then differ between APIs");
    app.flag("--allow-outside", words.allowsOutside,
             "#include files outside of the material's folder too: absolute paths, \"..\", links that lead out");
    app.flag("-w,--no-warnings", words.isQuiet, "print no warnings");
}

void addDefinitions(tools::CommandLine& app, Words& words) {
    app.option("-D,--define", words.defines, "NAME=VALUE: a macro in both blocks, also for #if").oneWord();
    app.option("-T,--template", words.templates, "NAME=VALUE: replaces ${NAME} everywhere in the text").oneWord();
}

/// The first definition that has no name; nothing: all are converted.
std::optional<std::string> convertDefinitions(Words const& words, Options& options) {
    for (std::string const& each : words.defines) {
        auto definition = nameAndValue(each);
        if (!definition) return each;
        options.defines.push_back(std::move(*definition));
    }
    for (std::string const& each : words.templates) {
        auto definition = nameAndValue(each);
        if (!definition) return each;
        options.templates.insert(std::move(*definition));
    }
    return std::nullopt;
}

/// The names of C compilers, which CLI11 would take for groups of one-letter flags.
std::vector<std::string> arguments(int argc, char** argv) {
    std::vector<std::string> words;
    for (int i = 1; i < argc; ++i) {
        const std::string_view given = argv[i];
        words.emplace_back(given == "-MD"                   ? "--write-dependencies"
                           : given == "-MF"                 ? "--dependency-file"
                           : given == "--preprocessor-only" ? "--preprocess"
                                                            : given);
    }
    return words;
}

int ended(int status) {
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
    const char* const extension = options.isDispatch() ? "" : ".fmat";
    if (namesFolder(options.output)) options.output += std::filesystem::path(input).stem().string() + extension;
    if (writesDependencies && options.dependencyFile.empty()) options.dependencyFile = options.output + ".d";
    return options;
}

} // namespace

Parsed parseOptions(int argc, char** argv) {
    Options options;
    std::vector<std::string> inputs;
    Words words;
    tools::CommandLine app{ "Compiles a material definition (.mat) into a material package (.fmat)." };
    app.footer(kEpilogue);
    app.versionFlag("--version", fmt::format("matc of filament_core {}, package format {}", versionText(),
                                             shader::format::kVersion));
    app.option("input", inputs, "the material definitions; - reads one from the standard input").required();
    addOutputs(app, options, words);
    addCompilation(app, options, words);
    addDefinitions(app, words);
    if (const std::optional<int> status = app.exitStatus(arguments(argc, argv))) return { {}, ended(*status) };
    if (const std::optional<std::string> wrong = convertDefinitions(words, options))
        return { {}, ended(app.reject("'" + *wrong + "' is not of the form NAME=VALUE")) };
    if (words.allowsOutside) options.includes = assets::FilesFrom::Anywhere;
    if (words.isQuiet) options.warn = false;
    if (const std::string problem = contradiction(options, inputs); !problem.empty()) {
        std::fprintf(stderr, "matc: %s\n", problem.c_str());
        return { {}, kUsage };
    }
    Parsed parsed;
    for (std::string const& input : inputs)
        parsed.materials.push_back(ofMaterial(options, input, words.writesDependencies));
    return parsed;
}

} // namespace filament_core::matc
