// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/files/FileBytes.h"

#include "base/Leftovers.h"
#include "base/NumberText.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace filament_core::assets {
namespace {

namespace fs = std::filesystem;

constexpr uintmax_t kMaxFileBytes = uintmax_t(4) << 30;

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

Error unreadable(std::filesystem::path const& path, const char* reason) {
    return fail(ErrorCode::Unreadable, "cannot read '{}': {}; check the path and its permissions", path.string(),
                reason);
}

Error unwritable(std::filesystem::path const& path, const char* reason) {
    return fail(ErrorCode::Unreadable, "cannot write '{}': {}; choose a directory with space and write permission",
                path.string(), reason);
}

bool writeAll(int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        bytes = bytes.subspan(static_cast<size_t>(written));
    }
    return true;
}

/// Writes and closes. Returns 0 or the first error: close() reports what some file systems delay.
int writeAndClose(int descriptor, std::span<const std::byte> bytes) {
    const int failed = writeAll(descriptor, bytes) ? 0 : errno;
    const bool closed = ::close(descriptor) == 0;
    return failed != 0 || closed ? failed : errno;
}

/// The file that `path` names through any number of links, whether or not it exists. The links of /proc, to which
/// /dev/stdout leads, are not followed: their files are open already, and need not have a name.
fs::path linkedFile(fs::path path, std::error_code& error) {
    constexpr int kMostLinks = 40; // as in Linux
    for (int i = 0; i < kMostLinks; ++i) {
        std::error_code none;
        if (path.native().starts_with("/proc/") || !fs::is_symlink(fs::symlink_status(path, none))) return path;
        const fs::path target = fs::read_symlink(path, error);
        if (error) return path;
        path = target.is_absolute() ? target : path.parent_path() / target;
    }
    error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
    return path;
}

Result<void> writeInto(fs::path const& path, std::span<const std::byte> bytes) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) return unwritable(path, std::strerror(errno));
    if (const int failed = writeAndClose(descriptor, bytes); failed != 0)
        return unwritable(path, std::strerror(failed));
    return {};
}

/// `mode`: permissions of the file that is replaced; 0: there is none.
Result<void> writeBeside(fs::path const& path, std::span<const std::byte> bytes, mode_t mode) {
    static std::atomic<uint32_t> serial{ 0 }; // unique within the process; the id makes it unique among processes
    // rename() replaces a file in one step, so a reader finds the old bytes or the new ones, never a part. It works
    // within one file system, so the temporary file is made beside the other.
    const std::string temporary = fmt::format("{}.{}-{}", path.string(), ::getpid(), serial.fetch_add(1));
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0) return unwritable(path, std::strerror(errno));
    if (mode != 0) ::fchmod(descriptor, mode); // cannot matter more than the contents
    int failed = writeAndClose(descriptor, bytes);
    if (failed == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) failed = errno;
    if (failed == 0) return {};
    ::unlink(temporary.c_str());
    return unwritable(path, std::strerror(failed));
}

/// The process id in the name of a temporary file, "NAME.ID-SERIAL"; 0 for other names.
pid_t writerOf(std::string_view name) {
    const size_t dot = name.rfind('.'), dash = name.rfind('-');
    if (dot == std::string_view::npos || dash == std::string_view::npos || dash < dot) return 0;
    const bool hasSerial = numberOf<uint32_t>(name.substr(dash + 1)).has_value();
    return hasSerial ? numberOf<pid_t>(name.substr(dot + 1, dash - dot - 1)).value_or(0) : 0;
}

} // namespace

Result<std::vector<std::byte>> readFileBytes(std::filesystem::path const& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) {
        return fail(ErrorCode::NotFound, "no file '{}'; check the path", path.string());
    }
    // Before the file is opened: opening a pipe would wait for its writer.
    if (!std::filesystem::is_regular_file(status)) return unreadable(path, "not a regular file");
    const uintmax_t size = std::filesystem::file_size(path, error);
    if (error) return unreadable(path, error.message().c_str());
    if (size > kMaxFileBytes) return unreadable(path, "larger than 4 GiB");
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file) return unreadable(path, std::strerror(errno));
    std::vector<std::byte> bytes(size);
    if (std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) {
        return unreadable(path, "it became shorter while being read");
    }
    return bytes;
}

Result<std::string> readText(std::filesystem::path const& path, size_t most) {
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file && errno == ENOENT)
        return fail(ErrorCode::NotFound, "cannot read '{}': there is no such file; check the path", path.string());
    if (!file) return unreadable(path, std::strerror(errno));
    std::string text;
    char buffer[65536];
    while (const size_t count = std::fread(buffer, 1, sizeof buffer, file.get())) {
        text.append(buffer, count);
        if (text.size() > most) return unreadable(path, fmt::format("larger than {} bytes", most).c_str());
    }
    if (std::ferror(file.get()) != 0) return unreadable(path, std::strerror(errno)); // also a directory
    return text;
}

Result<void> replaceFile(std::filesystem::path const& path, std::span<const std::byte> bytes) {
    std::error_code error;
    // Links are followed first: renaming onto a link would replace the link and leave its file as it was.
    const fs::path file = linkedFile(path, error);
    if (error) return unwritable(path, error.message().c_str());
    struct stat status {};
    const bool exists = ::stat(file.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) return unwritable(path, "it is a directory");
    // Devices and pipes are written to, because a rename would put a file in their place.
    if (file.native().starts_with("/proc/") || (exists && !S_ISREG(status.st_mode))) return writeInto(file, bytes);
    if (file.has_parent_path()) {
        fs::create_directories(file.parent_path(), error);
        if (error) return unwritable(path, error.message().c_str());
    }
    return writeBeside(file, bytes, exists ? status.st_mode & 07777 : 0);
}

size_t removeLeftovers(std::filesystem::path const& folder) { return removeLeftoverFiles(folder.c_str(), writerOf); }

} // namespace filament_core::assets
