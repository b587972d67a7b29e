// SPDX-License-Identifier: Apache-2.0
// filament-bake MODEL [options]: what a path tracer finds in a scene that does not move, as textures for the engine.
// Exit status 0: baked and written. 130: stopped by Ctrl-C; the same command continues.
#include "toolkit/program/Program.h"
#include "tools/bake/Options.h"

namespace filament_core::bake {
namespace {

int run(Options const& options) {
    return tools::failed(fail(ErrorCode::InvalidArgument, "{}: nothing is baked yet", options.model.string()));
}

} // namespace
} // namespace filament_core::bake

int main(int argc, char** argv) {
    using namespace filament_core;
    return tools::runProgram("filament-bake", argc, argv, bake::parseOptions, bake::run, "try a smaller model");
}
