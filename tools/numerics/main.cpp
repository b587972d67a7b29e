// SPDX-License-Identifier: Apache-2.0
// filament-numerics [--only TEXT] [--csv FILE] [--json FILE] [--write FILE]: evaluates every function of shaders/lib
// over edge grids in fp32 and fp16 on the CPU and both APIs, and compares with fp64. Exit status 0: every promise is
// kept. 1: some are broken, or the run failed. See docs/numerics.md.
#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/program/CommandLine.h"
#include "toolkit/program/Program.h"
#include "tools/numerics/Report.h"

#include <cstdio>

namespace filament_core::shader::numerics {
namespace {

using tools::failed;

struct Options {
    std::string only, csv, json, markdown;
};

void declare(tools::CommandLine& app, Options& options) {
    const tools::CommandLine::Option only =
            app.option("--only", options.only, "rows whose function contains this, or of this file").typeName("TEXT");
    app.option("--csv", options.csv, "write every count of every column").typeName("FILE");
    app.option("--json", options.json, "the same as JSON").typeName("FILE");
    app.option("--write", options.markdown, "write the tables of docs/numerics.md").typeName("FILE").excludes(only);
}

Result<void> write(std::string const& path, std::string const& text) {
    if (path.empty()) return {};
    return assets::replaceFile(path, std::as_bytes(std::span(text)));
}

int run(Options const& options) {
    const Result<Study> study = runStudy(options.only);
    if (!study) return failed(study.error());
    if (study->rows.empty())
        return failed(
                tools::invalidOption("--only", options.only, "part of a function's name, or a file of shaders/lib"));
    std::fputs(terminalTable(*study).c_str(), stdout);
    if (const Result<void> done = write(options.csv, csvOf(*study)); !done) return failed(done.error());
    if (const Result<void> done = write(options.json, jsonOf(*study)); !done) return failed(done.error());
    if (const Result<void> done = write(options.markdown, markdownOf(*study)); !done) return failed(done.error());
    const size_t broken = violationCount(*study);
    std::printf("%zu functions and cases, %zu broken promises\n", study->rows.size(), broken);
    return broken > 0 ? 1 : 0;
}

} // namespace
} // namespace filament_core::shader::numerics

int main(int argc, char** argv) {
    using namespace filament_core;
    tools::setProgramName("filament-numerics");
    tools::routeLogToConsole();
    tools::CommandLine app("Evaluates every function of shaders/lib over edge grids in every precision.",
                           "filament-numerics");
    shader::numerics::Options options;
    shader::numerics::declare(app, options);
    const Result<bool> parsed = app.parse(argc, argv);
    if (!parsed) return tools::failed(parsed.error());
    const int status = *parsed ? shader::numerics::run(options) : 0;
    const Result<void> printed = tools::finishOutput();
    return printed ? status : tools::failed(printed.error());
}
