// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/PagePictures.h"

#include "filament_core/assets/files/FileBytes.h"

#include <vector>

namespace filament_core::accuracy {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSource = "src=\"";

/// The positions of the texts in src="...", without the quotes.
struct Range {
    size_t begin, end;
};
std::vector<Range> sourcesOf(std::string_view html) {
    std::vector<Range> found;
    for (size_t at = html.find(kSource); at != std::string_view::npos; at = html.find(kSource, at)) {
        const size_t begin = at + kSource.size();
        at = html.find('"', begin);
        if (at == std::string_view::npos) break;
        found.push_back({ begin, at });
    }
    return found;
}

} // namespace

Result<std::string> PagePictures::add(fs::path const& picture) {
    const fs::path address = mPage.stem() / picture.filename();
    const auto [other, isNew] = mAdded.try_emplace(address.string(), picture);
    if (!isNew && other->second != picture)
        return fail(ErrorCode::InvalidArgument, "{} and {}: two pictures of one page need different names",
                    other->second.string(), picture.string());
    const fs::path file = mPage.parent_path() / address;
    std::error_code error;
    if (fs::equivalent(file, picture, error)) return address.string();
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(picture);
    if (!bytes) return bytes.error();
    if (const Result<void> written = assets::replaceFile(file, *bytes); !written) return written.error();
    return address.string();
}

Result<std::string> PagePictures::adopt(std::string const& fragment, fs::path const& folder) {
    std::string html;
    size_t done = 0;
    for (const auto [begin, end] : sourcesOf(fragment)) {
        const Result<std::string> address = add(folder / fragment.substr(begin, end - begin));
        if (!address) return address;
        html += fragment.substr(done, begin - done) + *address;
        done = end;
    }
    return html + fragment.substr(done);
}

void PagePictures::removeOthers() const {
    const auto bytes = assets::readFileBytes(mPage);
    if (!bytes) return; // there is no earlier report
    const std::string_view html(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    for (const auto [begin, end] : sourcesOf(html)) {
        const fs::path address = html.substr(begin, end - begin);
        const bool isOurs = address.parent_path() == mPage.stem() && !mAdded.contains(address.string());
        std::error_code error;
        if (isOurs) fs::remove(mPage.parent_path() / address, error);
    }
}

} // namespace filament_core::accuracy
