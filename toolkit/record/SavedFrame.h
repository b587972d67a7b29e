// SPDX-License-Identifier: Apache-2.0
/// SavedFrame: a folder with everything that draws one frame again. The format of bug reports (docs/saved-frames.md).
///   Files   frame.json (Manifest.h); NAME.png or NAME.exr of every image as it was shown; BACKEND.trace and
///           BACKEND.trace.bin with every command and its data for each API of the machine.
///   Save    a trace has the shaders of one API, so the caller's recipe draws the frame on each API, on a fresh engine.
///           Then every trace is replayed. A trace that does not draw the shown images is kept, and marked:
///           TraceRecord::problem.
///   Thread  saveFrame(): one at a time; the engines that it makes live on the calling thread. It takes seconds, so a
///           viewer calls it on a thread of its own, with a recipe that loads what it draws.
///   Fails   Unreadable for the folder; InvalidArgument for the request; errors of the recipe; DeviceUnavailable if no
///           API could draw.
///   Cost    for each API: the recipe, and a run of its trace. FlightHelmet at 640 x 360: docs/saved-frames.md.
#pragma once

#include "toolkit/record/Replay.h"

#include <filament_core/Engine.h>
#include <filament_core/Image.h>

#include <functional>

namespace filament_core::record {

struct FramePicture {
    std::string name = "picture"; ///< 1 to 32 of a-z, 0-9 and '-'; all of a frame have different ones
    Image image{};
    OutputSpace space = OutputSpace::Srgb; ///< of its codes
};

/// Draws the frame on a fresh engine, with a renderer and targets of its own, and returns its images. It may be
/// called several times, and must draw the same each time.
using FrameRecipe = std::function<Result<std::vector<FramePicture>>(Engine&)>;

struct SaveRequest {
    std::filesystem::path folder; ///< made if it is missing; a frame that was saved there is replaced
    FrameRecipe recipe;
    std::vector<FramePicture> shown; ///< as they were on the screen; empty: as the first API draws them
    std::vector<Backend> backends{ Backend::Vulkan, Backend::Gles }; ///< those without a device are noted
    EngineOptions engine{};      ///< of both; backend, traceFile and debug are set here
    std::string program;         ///< name of the caller
    std::string settings = "{}"; ///< JSON that says what was drawn, for people
};

/// Writes the folder and returns its contents. Whether the frame can be reproduced: problemsOf().
Result<Manifest> saveFrame(SaveRequest const& request);

/// One line for each API that does not draw what was shown, and for each that is absent.
std::vector<std::string> problemsOf(Manifest const& manifest);

/// What the replay of one trace gave.
struct Verdict {
    std::string device, driver;
    std::vector<FramePicture> pictures; ///< as drawn now; without pixels if the device did not answer
    std::string difference;             ///< the first one to what was recorded, in one line; empty: all is equal
    std::vector<std::string> errors;    ///< of the device
};

/// Replays a trace on its own API and compares the images with those that were shown.
Result<Verdict> compareReplay(Manifest const& manifest, Trace const& trace, ReplayRequest const& request = {});

/// Where the replay first differs from the attachments that were recorded: "frame 1, pass 3 'color', attachment 'hdr'";
/// empty if nowhere.
Result<std::string> firstChangedPass(Manifest const& manifest, Trace const& trace, ReplayRequest const& request = {});

/// The first pass and draw after which the traces of two APIs disagree; empty if nowhere. Frames are matched from the
/// last one back.
Result<std::string> firstDisagreement(Trace const& a, ReplayRequest const& ofA, Trace const& b,
                                      ReplayRequest const& ofB);

} // namespace filament_core::record
