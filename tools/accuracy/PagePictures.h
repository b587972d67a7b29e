// SPDX-License-Identifier: Apache-2.0
/// PagePictures: the images of an HTML page, as files in the folder of its name: docs/accuracy.html shows
/// docs/accuracy/*.
///   In      images where the measurement left them; fragments of HTML whose images are relative to the fragment.
///   Out     copies under the same names.
///   Fails   Unreadable with the path; InvalidArgument if two images have one name.
///   Thread  one.
#pragma once

#include "base/Result.h"

#include <filesystem>
#include <map>
#include <string>

namespace filament_core::accuracy {

class PagePictures {
public:
    explicit PagePictures(std::filesystem::path page) : mPage(std::move(page)) {}

    /// Copies the image. Returns its address as seen from the page.
    Result<std::string> add(std::filesystem::path const& picture);

    /// Adds every image that the fragment shows, src="..." relative to `folder`. Returns the fragment with their new
    /// addresses.
    Result<std::string> adopt(std::string const& fragment, std::filesystem::path const& folder);

    /// Deletes images that the page's file shows and that have not been added: those of an earlier report. To be
    /// called before the file is replaced.
    void removeOthers() const;

private:
    std::filesystem::path mPage;
    std::map<std::string, std::filesystem::path> mAdded; ///< address, where it came from
};

} // namespace filament_core::accuracy
