// SPDX-License-Identifier: Apache-2.0
/// Merge: one image from partial films (FilmFile.h), with the bits of one run that is not divided.
///   In      files, or folders with a part.film, in any order.
///   Memory  the image (PartialFilm.h) and one part.
///   Fails   InvalidArgument for parts that differ in what they draw, overlap, are given twice, or do not cover the
///           image; Corrupt and Unreadable for their files. The message names the file and what to do.
///   Thread  one.
#pragma once

#include "tools/reference/FilmFile.h"

namespace filament_core::reference {

struct FilmPart {
    std::filesystem::path file;
    PartHeader header;
};

/// Whether the parts are one image.
Result<void> checkParts(std::vector<FilmPart> const& parts);

struct MergedPicture {
    PictureSettings settings;
    ReferenceImage image;
};
Result<MergedPicture> mergeParts(std::vector<std::filesystem::path> const& files);

} // namespace filament_core::reference
