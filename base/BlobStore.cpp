// SPDX-License-Identifier: Apache-2.0
#include "base/BlobStore.h"

#include "base/Hash.h"
#include "base/Leftovers.h"
#include "base/Log.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

namespace filament_core {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "a blob store is little-endian");

constexpr uint64_t kMagic = 0x31424F4C424C4946; // "FILBLOB1"

struct FileHeader {
    uint64_t magic, identity, checksum; // the checksum covers everything after the header
};
struct EntryHeader {
    uint64_t key, bytes;
};

std::optional<std::vector<char>> contents(fs::path const& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return std::nullopt;
    return std::vector<char>(std::istreambuf_iterator<char>(file), {});
}

void removeLeftovers(fs::path const& file) {
    const std::string prefix = file.filename().string() + '.';
    const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
    removeLeftoverFiles(folder.c_str(), [&](std::string_view name) {
        pid_t writer = 0;
        if (!name.starts_with(prefix)) return writer;
        const char* const end = name.data() + name.size();
        const auto [read, error] = std::from_chars(name.data() + prefix.size(), end, writer);
        return error == std::errc() && read == end ? writer : 0;
    });
}

template <class T>
void append(std::vector<std::byte>& out, T const& value) {
    const size_t at = out.size();
    out.resize(at + sizeof(value));
    std::memcpy(out.data() + at, &value, sizeof(value));
}

} // namespace

BlobStore::BlobStore(fs::path file, uint64_t identity, uint64_t maxBytes)
        : mFile(std::move(file)), mIdentity(identity), mMaxBytes(maxBytes) {
    const auto bytes = contents(mFile);
    if (!bytes || read(std::as_bytes(std::span(*bytes)))) return;
    mBlobs.clear();
    log(Severity::Warning, "'{}' is damaged or from another device: its contents are generated again", mFile.string());
}

bool BlobStore::read(std::span<const std::byte> file) {
    FileHeader header;
    if (file.size() < sizeof(header)) return false;
    std::memcpy(&header, file.data(), sizeof(header));
    std::span<const std::byte> rest = file.subspan(sizeof(header));
    if (header.magic != kMagic || header.identity != mIdentity || header.checksum != hashBytes(rest)) return false;
    while (!rest.empty()) {
        EntryHeader entry;
        if (rest.size() < sizeof(entry)) return false;
        std::memcpy(&entry, rest.data(), sizeof(entry));
        rest = rest.subspan(sizeof(entry));
        if (entry.bytes > rest.size()) return false;
        const auto bytes = rest.first(entry.bytes);
        if (!mBlobs.try_emplace(entry.key, Blob{ { bytes.begin(), bytes.end() } }).second) return false;
        rest = rest.subspan(entry.bytes);
    }
    return true;
}

std::span<const std::byte> BlobStore::find(uint64_t key) {
    const auto found = mBlobs.find(key);
    if (found == mBlobs.end()) return {};
    found->second.isUsed = true;
    return found->second.bytes;
}

void BlobStore::put(uint64_t key, std::span<const std::byte> bytes) {
    Blob blob{ { bytes.begin(), bytes.end() }, true };
    const auto found = mBlobs.find(key);
    if (found != mBlobs.end() && found->second.bytes == blob.bytes) return;
    mBlobs[key] = std::move(blob);
    mHasChanged = true;
}

void BlobStore::erase(uint64_t key) { mHasChanged = mBlobs.erase(key) > 0 || mHasChanged; }

void BlobStore::shrink() {
    const auto fileBytes = [](Blob const& blob) { return sizeof(EntryHeader) + blob.bytes.size(); };
    uint64_t total = sizeof(FileHeader);
    for (auto const& [key, blob] : mBlobs) total += fileBytes(blob);
    while (total > mMaxBytes && !mBlobs.empty()) {
        const auto least = std::ranges::min_element(mBlobs, [](auto const& a, auto const& b) {
            if (a.second.isUsed != b.second.isUsed) return b.second.isUsed;
            return a.second.bytes.size() > b.second.bytes.size();
        });
        total -= fileBytes(least->second);
        mBlobs.erase(least);
    }
}

std::vector<std::byte> BlobStore::encode() const {
    std::vector<std::byte> file;
    append(file, FileHeader{ kMagic, mIdentity, 0 });
    for (auto const& [key, blob] : mBlobs) {
        append(file, EntryHeader{ key, blob.bytes.size() });
        file.insert(file.end(), blob.bytes.begin(), blob.bytes.end());
    }
    const uint64_t checksum = hashBytes(std::span(file).subspan(sizeof(FileHeader)));
    std::memcpy(file.data() + offsetof(FileHeader, checksum), &checksum, sizeof(checksum));
    return file;
}

void BlobStore::save() {
    if (!mHasChanged) return;
    shrink();
    const std::vector<std::byte> bytes = encode();
    std::error_code failed;
    fs::create_directories(mFile.parent_path(), failed);
    fs::path unfinished = mFile;
    unfinished += fmt::format(".{}", getpid());
    std::ofstream out(unfinished, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (out) fs::rename(unfinished, mFile, failed);
    if (out && !failed) {
        mHasChanged = false;
        removeLeftovers(mFile);
        return;
    }
    log(Severity::Warning, "'{}' cannot be written: nothing is kept for the next run", mFile.string());
    fs::remove(unfinished, failed);
}

} // namespace filament_core
