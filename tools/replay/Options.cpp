// SPDX-License-Identifier: Apache-2.0
#include "tools/replay/Options.h"

#include "toolkit/program/CommandLine.h"

namespace filament_core::replay {
namespace {

using tools::invalidOption;
using tools::wholeNumber;

constexpr uint32_t kMostNumber = 1'000'000'000;

constexpr const char* kDescription = "Draws a saved frame again from its recorded commands, and compares the bits of "
                                     "its pictures with those that were "
                                     "shown.";
constexpr const char* kFooter = R"(What it does:
  without --list, --stop-after-... and --step
                 replays the trace of each API and compares. A picture that differs is followed by the first
                 pass with other bits than when the frame was saved, and, if both APIs are here, by the first
                 pass and draw after which they disagree.
  --list         names frames, passes and draws; needs no device.
  --stop-after-pass, --stop-after-draw
                 cut the frame off there; --out gets what the attachments of that pass hold.
  --step DIR     does so after every draw, or after those of --stop-after-pass. Each draw costs a replay.
Exit status 0: every picture, or attachment, has the recorded bits. 1: it has not, or could not be drawn.
Example: filament-replay frame --list
         filament-replay frame --backend gles --stop-after-draw 12 --out here
A trace holds programs for the graphics device. Replay only what you would run.)";

/// The words as given.
struct Words {
    std::string folder, backend = "all", requireDevice, out, step, stopAfterPass, stopAfterDraw, frame;
};

Result<void> convertBackend(Words const& words, Options& options) {
    if (words.backend == "all") return {};
    for (const Backend backend : { Backend::Vulkan, Backend::Gles, Backend::Null }) {
        if (words.backend == toString(backend)) options.backends = { backend };
    }
    if (options.backends.empty()) return invalidOption("--backend", words.backend, "vulkan, gles, null or all");
    return {};
}

Result<void> convertPlaces(Words const& words, Options& options) {
    if (!words.stopAfterPass.empty()) options.stopAfterPass = words.stopAfterPass;
    if (!words.stopAfterDraw.empty()) {
        options.stopAfterDraw = wholeNumber(words.stopAfterDraw, 1, kMostNumber);
        if (!options.stopAfterDraw)
            return invalidOption("--stop-after-draw", words.stopAfterDraw, "the number of a draw of --list, from 1");
    }
    if (!words.frame.empty()) {
        options.frame = wholeNumber(words.frame, 1, kMostNumber);
        if (!options.frame) return invalidOption("--frame", words.frame, "the number of a frame of --list, from 1");
    }
    if (options.stopAfterPass && options.stopAfterDraw)
        return invalidOption("--stop-after-draw", words.stopAfterDraw, "it without --stop-after-pass");
    if (!words.step.empty() && options.stopAfterDraw)
        return invalidOption("--step", words.step, "it without --stop-after-draw");
    return {};
}

} // namespace

Result<std::optional<Options>> parseOptions(int argc, const char* const* argv) {
    Options options;
    Words words;
    tools::CommandLine app{ kDescription, "filament-replay" };
    app.footer(kFooter);
    app.option("FOLDER", words.folder, "a saved frame: the folder with frame.json");
    app.option("--backend", words.backend,
               "vulkan, gles, null (checks the commands without a device) or all (default)");
    app.option("--require-device", words.requireDevice, "fail unless the device's name contains this");
    app.option("--frame", words.frame, "NUMBER of the frame to look into, as listed (the last one)");
    app.flag("--list", options.list, "print the frames, passes and draws");
    app.option("--stop-after-pass", words.stopAfterPass, "NUMBER or NAME of a pass");
    app.option("--stop-after-draw", words.stopAfterDraw, "NUMBER of a draw within the frame");
    app.option("--step", words.step, "DIR: write what every draw left in the attachments of its pass");
    app.option("--out", words.out, "DIR: write the pictures, or the attachments of the pass");
    const Result<bool> parsed = app.parse(argc, argv);
    if (!parsed) return parsed.error();
    if (!*parsed) return std::optional<Options>{};
    if (words.folder.empty())
        return invalidOption("FOLDER", words.folder, "a folder that --save-frame of filament-render wrote");
    options.folder = words.folder;
    options.requireDevice = words.requireDevice;
    options.out = words.out;
    options.step = words.step;
    for (auto convert : { convertBackend, convertPlaces }) {
        if (const Result<void> done = convert(words, options); !done) return done.error();
    }
    return std::optional(std::move(options));
}

} // namespace filament_core::replay
