// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/files/FileBytes.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace filament::assets {
namespace {

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

} // namespace

Result<std::vector<std::byte>> readFileBytes(std::filesystem::path const& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) {
        return fail(ErrorCode::NotFound, "no file '{}'; check the path", path.string());
    }
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

Result<void> replaceFile(std::filesystem::path const& path, std::span<const std::byte> bytes) {
    std::error_code error;
    if (path.has_parent_path()) {
        std::filesystem::create_directories(path.parent_path(), error);
        if (error) return unwritable(path, error.message().c_str());
    }
    static std::atomic<uint32_t> serial{ 0 }; // unique within the process; the id makes it unique among processes
    const std::string temporary = fmt::format("{}.{}-{}", path.string(), ::getpid(), serial.fetch_add(1));
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0) return unwritable(path, std::strerror(errno));
    const bool wrote = writeAll(descriptor, bytes);
    const int writeError = errno;
    const bool closed = ::close(descriptor) == 0;
    if (!wrote || !closed) {
        ::unlink(temporary.c_str());
        return unwritable(path, std::strerror(wrote ? errno : writeError));
    }
    std::filesystem::rename(temporary, path, error);
    if (error) {
        ::unlink(temporary.c_str());
        return unwritable(path, error.message().c_str());
    }
    return {};
}

} // namespace filament::assets
