// SPDX-License-Identifier: Apache-2.0
/// BlobStore: bytes by 64-bit key, kept in one file between runs, such as compiled programs.
///   In      a file, an identity that must match (a hash of device, driver, versions), and the maximum size of the
///           file.
///   File    little-endian: magic, identity, hash of the rest; then key, size and bytes of every entry. It is written
///           under another name and renamed, so that readers find either the old file or the new one.
///   Limits  save() drops entries that this run did not request, then the largest ones, until the rest fits.
///   Thread  one at a time; several processes may use one file, and the last one to save wins.
///   Fails   a file that cannot be read, or has another identity, counts as empty, with one warning that names it.
///           Failing to write is a warning too. On std::bad_alloc find() and put() change nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <vector>

namespace filament_core {

class BlobStore {
public:
    BlobStore(std::filesystem::path file, uint64_t identity, uint64_t maxBytes);

    /// Empty if there is none. Valid until put().
    std::span<const std::byte> find(uint64_t key);
    void put(uint64_t key, std::span<const std::byte> bytes);
    void erase(uint64_t key);
    size_t size() const { return mBlobs.size(); }
    /// Does nothing if nothing has changed since the file was read. Also deletes what killed processes left beside it.
    void save();

private:
    struct Blob {
        std::vector<std::byte> bytes;
        bool isUsed = false; ///< in this run
    };

    bool read(std::span<const std::byte> file);
    std::vector<std::byte> encode() const;
    void shrink();

    std::filesystem::path mFile;
    uint64_t mIdentity;
    uint64_t mMaxBytes;
    std::map<uint64_t, Blob> mBlobs;
    bool mHasChanged = false;
};

} // namespace filament_core
