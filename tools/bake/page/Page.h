// SPDX-License-Identifier: Apache-2.0
/// Page: the report of a bake as one HTML file, with its images inside.
///   Thread  one.   Fails: Unreadable with the path.
#pragma once

#include "base/Result.h"

#include <filament_core/Image.h>

#include <filesystem>
#include <string>
#include <vector>

namespace filament_core::bake {

struct PagePicture {
    std::string title;
    Image image;        ///< RGBA8
    bool isMap = false; ///< its pixels are data: shown large, with sharp edges
};

struct PageTable {
    std::string title;
    std::vector<std::string> columns;             ///< the first one is text, the others are numbers
    std::vector<std::vector<std::string>> rows{}; ///< cells, as many each
};

struct PageSection {
    std::string title;
    std::vector<std::string> sentences{};
    std::vector<PagePicture> pictures{};
    std::vector<PageTable> tables{};
};

struct Page {
    std::string title;
    std::vector<PageSection> sections;
};

Result<void> writePage(std::filesystem::path const& path, Page const& page);

} // namespace filament_core::bake
