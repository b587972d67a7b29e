// SPDX-License-Identifier: Apache-2.0
/// Manifest: frame.json, the table of contents of a saved frame (docs/saved-frames.md).
///   In      JSON of any origin.   Out: a checked value; writing what was read gives the same text.
///   Limits  16 MiB; the counts and lengths below. File names are not in it: they follow from the names of APIs and
///           images, so that no folder names a file outside of itself.
///   Thread  any; plain values.
///   Fails   NotFound, Corrupt or Unreadable in one line: the file, the field, what was expected.
#pragma once

#include "base/Result.h"

#include <filament_core/Backend.h>
#include <filament_core/DisplayTransform.h>
#include <filament_core/Format.h>
#include <filament_core/Math.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::record {

inline constexpr size_t kMaxManifestBytes = size_t{ 16 } << 20, kMaxSettingsBytes = size_t{ 1 } << 20;
inline constexpr uint32_t kMaxPictures = 8, kMaxHashedFrames = 8, kMaxPasses = 4096, kMaxAttachments = 16,
                          kMaxPictureSide = 16384;

/// An image of the frame as it was shown: what every replay must draw.
struct PictureRecord {
    std::string name = "picture";  ///< 1 to 32 of a-z, 0-9 and '-'
    Format format = Format::RGBA8; ///< RGBA8, RGBA8Srgb, RGB10A2 (NAME.png) or RGBA16F (NAME.exr)
    uint2 size{ 1 };
    OutputSpace space = OutputSpace::Srgb; ///< of a PNG's codes
    uint64_t hash = 0;                     ///< hashBytes() of its tightly packed pixels
};

/// What one attachment of a pass held after it.
struct AttachmentRecord {
    std::string name;
    Format format = Format::None; ///< depth: D32F
    uint2 size{ 1 };
    uint64_t hash = 0;
};

struct PassRecord {
    std::string name;
    uint32_t draws = 0;
    std::vector<AttachmentRecord> attachments;
};

/// One call of Renderer::render() in the trace.
struct FrameRecord {
    uint32_t index = 0; ///< in the trace, from 0
    std::vector<PassRecord> passes;
};

/// An image as this trace draws it.
struct DrawnPicture {
    uint64_t ticket = 0; ///< of the read-back that answers with its pixels; 0: the trace has none
    uint64_t hash = 0;
};

/// The commands of one API.
struct TraceRecord {
    Backend backend = Backend::Vulkan;
    std::string device, driver;
    uint64_t textBytes = 0, textHash = 0;       ///< of BACKEND.trace
    uint64_t payloadBytes = 0, payloadHash = 0; ///< of BACKEND.trace.bin
    std::string problem;                        ///< why it does not draw the images that were shown; empty: it does
    std::vector<DrawnPicture> pictures;
    std::vector<FrameRecord> frames; ///< the last ones of the trace
};

/// An API that could not draw the frame when it was saved.
struct AbsentBackend {
    Backend backend = Backend::Vulkan;
    std::string reason;
};

struct Manifest {
    std::string program, commit, machine; ///< who saved it, and where
    std::string settings = "{}";          ///< JSON of the caller
    std::vector<PictureRecord> pictures;
    std::vector<TraceRecord> traces;
    std::vector<AbsentBackend> absent;
};

/// Null: there is none for this API.
TraceRecord const* findTrace(Manifest const& manifest, Backend backend);
bool isPictureName(std::string_view name);
bool isPictureFormat(Format format); ///< of PictureRecord

std::filesystem::path manifestPath(std::filesystem::path const& folder);
std::filesystem::path tracePath(std::filesystem::path const& folder, Backend backend);
std::filesystem::path payloadPath(std::filesystem::path const& folder, Backend backend);
std::filesystem::path picturePath(std::filesystem::path const& folder, PictureRecord const& picture);

std::string toJson(Manifest const& manifest);
/// `name` begins every message.
Result<Manifest> parseManifest(std::string_view text, std::string const& name);
/// frame.json of a folder.
Result<Manifest> readManifest(std::filesystem::path const& folder);
Result<void> writeManifest(std::filesystem::path const& folder, Manifest const& manifest);

} // namespace filament_core::record
