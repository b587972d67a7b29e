// SPDX-License-Identifier: Apache-2.0
/// matinfo: shows what a material package (.fmat) holds.
///   Out     parameters, constants, sizes of the variants; with --code the code of one stage.
///   Status  0: printed; 1: the package, or what was asked of it; 2: the command line.
#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/program/CommandLine.h"
#include "toolkit/program/StandardOutput.h"
#include "tools/matinfo/Describe.h"

#include <cstdio>
#include <string>

namespace {

using namespace filament_core;

struct Options {
    std::string input, code, stage = "fragment";
    uint32_t variant = 0;
};

Result<void> run(Options const& options) {
    const auto bytes = assets::readFileBytes(options.input);
    if (!bytes) return bytes.error();
    const Result<shader::MaterialPackage> package = shader::readPackage(*bytes);
    if (!package) return fail(package.error().code, "{}: {}", options.input, package.error().message);
    if (options.code.empty()) return tools::printText(matinfo::describe(*package, bytes->size()));
    const auto stage = options.stage == "vertex" ? matinfo::Stage::Vertex : matinfo::Stage::Fragment;
    const auto language = options.code == "opengl" ? matinfo::Language::Essl : matinfo::Language::Spirv;
    const Result<std::string> text = matinfo::codeOf(*package, options.variant, stage, language);
    if (!text) return fail(text.error().code, "{}: {}", options.input, text.error().message);
    return tools::printText(*text);
}

} // namespace

int main(int argc, char** argv) {
    Options options;
    tools::CommandLine app{ "Shows what a material package (.fmat) holds." };
    app.option("input", options.input, "the package").required();
    app.option("--code", options.code, "print the code for this API: GLSL, or SPIR-V as text")
            .oneOf({ "opengl", "vulkan" });
    app.option("--variant", options.variant, "key of the variant whose code is printed (default: 0)");
    app.option("--stage", options.stage, "stage whose code is printed (default: fragment)")
            .oneOf({ "vertex", "fragment" });
    if (const std::optional<int> status = app.exitStatus(argc, argv)) {
        if (!tools::finishOutput()) return 1;
        return *status == 0 ? 0 : 2;
    }
    const Result<void> done = run(options);
    if (!done) std::fprintf(stderr, "matinfo: %s\n", done.error().message.c_str());
    return done ? 0 : 1;
}
