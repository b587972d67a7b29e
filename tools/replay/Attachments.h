// SPDX-License-Identifier: Apache-2.0
/// Attachments as picture files: RGBA8 as PNG; RGBA16F as EXR, bit for bit; all others as EXR of 32-bit floats, in
/// which components that the format lacks are 0.
///   Thread  any.  Fails: Unreadable with path and reason; Internal for an attachment that was not read back.
#pragma once

#include "toolkit/record/SavedFrame.h"

namespace filament_core::replay {

/// Letters, digits, '-' and '.' of a name of unknown origin; '_' for all between them.
std::string fileStem(std::string_view name);

/// Writes FOLDER/STEM.png or FOLDER/STEM.exr, and returns its path.
Result<std::filesystem::path> saveAttachment(std::filesystem::path const& folder, std::string const& stem,
                                             backend::CapturedAttachment const& attachment);

/// A picture as replayed: FOLDER/STEM.png or FOLDER/STEM.exr.
Result<std::filesystem::path> savePicture(std::filesystem::path const& folder, std::string const& stem,
                                          record::FramePicture const& picture);

} // namespace filament_core::replay
