// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/files/PathInside.h"

#include <algorithm>
#include <system_error>

namespace filament_core::assets {
namespace {

namespace fs = std::filesystem;

bool isBelow(fs::path const& file, fs::path const& folder) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

Error outside(std::string_view relative, const char* how) {
    return fail(ErrorCode::InvalidArgument,
                "'{}' lies outside the folder of the file that names it{}; store it inside, or allow files from "
                "anywhere",
                relative.substr(0, 80), how);
}

} // namespace

Result<std::filesystem::path> fileInside(std::filesystem::path const& folder, std::string_view relative,
                                         FilesFrom from) {
    if (relative.find('\0') != std::string_view::npos)
        return fail(ErrorCode::InvalidArgument, "the path '{}' has a zero byte",
                    relative.substr(0, relative.find('\0')));
    const fs::path named(relative), shown = folder / named;
    if (from == FilesFrom::Anywhere) return shown;
    // The text of the path is checked before the file system is used: otherwise the errors would tell which files exist
    // outside of the folder.
    if (named.is_absolute()) return outside(relative, " (it is absolute)");
    const fs::path plain = named.lexically_normal();
    if (!plain.empty() && *plain.begin() == "..") return outside(relative, "");
    std::error_code error;
    const fs::path root = fs::canonical(folder.empty() ? "." : folder, error);
    if (error) return fail(ErrorCode::NotFound, "no folder '{}'", folder.string());
    const fs::path file = fs::canonical(shown, error);
    if (error == std::errc::no_such_file_or_directory) return fail(ErrorCode::NotFound, "no file '{}'", shown.string());
    if (error) return fail(ErrorCode::Unreadable, "'{}': {}", shown.string(), error.message());
    // Only canonical paths show where links lead.
    if (!isBelow(file, root)) return outside(relative, " (through a link)");
    return file;
}

} // namespace filament_core::assets
