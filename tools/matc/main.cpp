// SPDX-License-Identifier: Apache-2.0
/// matc: compiles material definitions (.mat) into packages (.fmat). Options.h has the command line. While the engine
/// is built, also its compute stages (.comp), into a file for each language.
///   Out     the same bytes for any number of threads and of materials. Of a material with an error, also a full disk,
///           nothing is written: an old package stays as it was.
///   In      the material, and #include files of its folder (--allow-outside: of any), 1 MiB together. A material of
///           the standard input lies in the current folder.
///   Status  Options.h. The reason is on standard error, as the guide shows it (5.1): a line "ERROR: file:line: reason"
///           for each mistake, with the line of the author's file, and which material was not compiled.
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/files/PathInside.h"
#include "jobsystem/JobSystem.h"
#include "shaders/compiler/Cost.h"
#include "shaders/compiler/DispatchCompiler.h"
#include "shaders/compiler/MaterialCompiler.h"
#include "shaders/compiler/MaterialDefinition.h"
#include "shaders/compiler/Templates.h"
#include "toolkit/program/StandardOutput.h"
#include "tools/matc/Options.h"

#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace filament_core::matc {
namespace {

constexpr size_t kMaxTextBytes = 1 << 20; // as the compiler's limit for a material with its includes

/// The files of a material: read for the compiler, expanded, and noted. Any thread.
class Files {
public:
    explicit Files(Options const& options) : mOptions(options) {}

    std::string name() const { return mOptions.readsStandardInput() ? "standard input" : mOptions.input; }

    Result<std::string> material() {
        Result<std::string> text =
                assets::readText(mOptions.readsStandardInput() ? "/dev/stdin" : mOptions.input, kMaxTextBytes);
        if (!text) return text.error();
        if (!mOptions.readsStandardInput()) mRead.insert(mOptions.input);
        return expanded(*text, name());
    }

    /// Files beside the material; see --allow-outside.
    std::optional<std::string> include(std::string_view path) {
        const std::filesystem::path folder = std::filesystem::path(mOptions.input).parent_path();
        const Result<std::filesystem::path> file = assets::fileInside(folder, path, mOptions.includes);
        if (!file) return std::nullopt;
        const Result<std::string> text = assets::readText(*file, kMaxTextBytes);
        if (!text) return std::nullopt;
        Result<std::string> whole = expanded(*text, path);
        const std::scoped_lock lock(mMutex);
        mRead.insert(file->string());
        if (!whole && !mProblem) mProblem = whole.error();
        return whole ? std::optional(std::move(*whole)) : std::nullopt;
    }

    /// What an include lacked: the compiler knows only that there is none.
    std::optional<Error> const& problem() const { return mProblem; }

    /// "stone.fmat: stone.mat noise.glsl"
    std::string rule() const {
        const std::string target = mOptions.output.empty()
                                           ? std::filesystem::path(name()).replace_extension(".fmat").string()
                                           : mOptions.output;
        std::string text = escaped(target) + ":";
        for (std::string const& file : mRead) {
            text += ' ';
            text += escaped(file);
        }
        text += '\n';
        return text;
    }

private:
    Result<std::string> expanded(std::string const& text, std::string_view fileName) const {
        if (mOptions.templates.empty()) return text;
        return shader::expandTemplates(text, fileName, mOptions.templates);
    }

    static std::string escaped(std::string const& path) {
        std::string out;
        for (const char c : path) {
            if (c == ' ' || c == '#' || c == '\\') out += '\\';
            if (c == '$') out += '$';
            out += c;
        }
        return out;
    }

    Options const& mOptions;
    std::mutex mMutex;
    std::set<std::string> mRead;
    std::optional<Error> mProblem;
};

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

/// jobs: null compiles on the calling thread.
Result<shader::CompileOptions> compileOptions(Options const& options, Files& files, jobs::JobSystem* jobs) {
    const Result<uint16_t> filtered = shader::variantBitsOfFilters(options.filters);
    if (!filtered) return filtered.error();
    shader::CompileOptions out{ .exact = !options.inexact, .filteredVariants = *filtered, .jobs = jobs };
    if (options.platform == "mobile") out.platform = shader::Platform::Mobile;
    if (options.platform == "desktop") out.platform = shader::Platform::Desktop;
    out.spirv = options.api != "opengl";
    out.essl = options.api != "vulkan";
    if (options.optimizeSize) out.optimization = shader::Optimization::Size;
    if (options.noOptimization) out.optimization = shader::Optimization::None;
    out.defines = options.defines;
    out.includes = [&files](std::string_view path) { return files.include(path); };
    return out;
}

Result<void> writeRule(Options const& options, Files const& files) {
    if (options.dependencyFile.empty()) return {};
    const std::string rule = files.rule();
    const auto bytes = std::as_bytes(std::span(rule));
    return write(options.dependencyFile, { bytes.begin(), bytes.end() });
}

Result<void> compile(Options const& options, Files& files, std::string const& text, shader::CompileOptions& how) {
    std::vector<std::string> warnings;
    if (options.warn) how.warnings = &warnings;
    const Result<shader::MaterialPackage> package = shader::compileMaterial(text, files.name(), how);
    if (!package) return package.error();
    for (std::string const& warning : warnings) std::fprintf(stderr, "WARNING: %s\n", warning.c_str());
    if (Result<void> written = write(options.output, shader::writePackage(*package)); !written) return written;
    return writeRule(options, files);
}

/// A compute stage of the engine's own: OUTPUT.spv and OUTPUT.essl.
Result<void> compileDispatch(Options const& options, Files const& files, std::string const& text) {
    const Result<shader::StageCode> code = shader::compileDispatch(text, files.name());
    if (!code) return code.error();
    const auto writeBytes = [&](const char* extension, std::span<const std::byte> bytes) {
        return write(options.output + extension, { bytes.begin(), bytes.end() });
    };
    Result<void> written = writeBytes(".spv", std::as_bytes(std::span(code->spirv)));
    return written ? writeBytes(".essl", std::as_bytes(std::span(code->essl))) : written;
}

Result<void> run(Options const& options, Files& files, jobs::JobSystem* jobs) {
    const Result<std::string> text = files.material();
    if (!text) return text.error();
    if (options.isDispatch()) return compileDispatch(options, files, *text);
    Result<shader::CompileOptions> how = compileOptions(options, files, jobs);
    if (!how) return how.error();
    if (options.preprocess) return print(shader::preprocessMaterial(*text, files.name(), *how));
    if (options.cost) return print(shader::costReport(*text, files.name(), *how));
    if (!options.reflect.empty()) return print(shader::reflectParameters(*text, files.name(), *how));
    if (options.printDependencies) {
        const Result<std::string> all = shader::preprocessMaterial(*text, files.name(), *how); // reads every file
        return all ? tools::printText(files.rule()) : Result<void>(all.error());
    }
    return compile(options, files, *text, *how);
}

Result<void> guarded(Options const& options, Files& files, jobs::JobSystem* jobs) {
    try {
        Result<void> done = run(options, files, jobs);
        return !done && files.problem() ? *files.problem() : done;
    } catch (std::exception const& error) {
        return fail(ErrorCode::OutOfMemory, "{}: out of resources ({}); try a smaller material, or -j 1", files.name(),
                    error.what());
    }
}

/// "ERROR: " before each line.
std::string errorLines(std::string_view message) {
    std::string text = "ERROR: ";
    for (const char c : message) {
        text += c;
        if (c == '\n') text += "ERROR: ";
    }
    return text;
}

/// Whether the material was compiled. Any thread; one call writes its report.
bool compileOne(Options const& options, jobs::JobSystem* jobs) {
    Files files(options);
    const Result<void> done = guarded(options, files, jobs);
    if (done) return true;
    std::fprintf(stderr, "%s\n\nCould not compile material %s\n", errorLines(done.error().message).c_str(),
                 files.name().c_str());
    return false;
}

/// One material: its stages side by side. Several: themselves, because the longest stage of each takes most of its
/// time.
int runProgram(int argc, char** argv) {
    const Parsed parsed = parseOptions(argc, argv);
    std::vector<Options> const& materials = parsed.materials;
    if (materials.empty()) return parsed.status;
    const int threads = materials.front().threads;
    jobs::JobSystem jobs({ .workers = threads > 0 ? threads - 1 : -1 });
    if (materials.size() == 1) return compileOne(materials.front(), &jobs) ? kDone : kFailed;
    std::atomic<bool> allDone = true;
    jobs::parallelFor<"compile material">(jobs, materials.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            if (!compileOne(materials[i], nullptr)) allDone = false;
        }
    });
    return allDone ? kDone : kFailed;
}

} // namespace
} // namespace filament_core::matc

int main(int argc, char** argv) { return filament_core::matc::runProgram(argc, argv); }
