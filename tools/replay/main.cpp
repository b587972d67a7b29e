// SPDX-License-Identifier: Apache-2.0
// filament-replay FOLDER [options]: draws a saved frame again and compares the bits. docs/saved-frames.md
// Exit status 0: everything has the recorded bits.
#include "toolkit/program/Program.h"
#include "tools/replay/ReplayFolder.h"

namespace filament_core::replay {
namespace {

int run(Options const& options) {
    const Result<Report> report = replayFolder(options);
    tools::clearProgress();
    if (!report) return tools::failed(report.error());
    if (const Result<void> printed = tools::printText(report->text); !printed) return tools::failed(printed.error());
    return report->isEqual ? 0 : 1;
}

} // namespace
} // namespace filament_core::replay

int main(int argc, char** argv) {
    using namespace filament_core;
    return tools::runProgram("filament-replay", argc, argv, replay::parseOptions, replay::run,
                             "close other programs: a trace needs twice its size");
}
