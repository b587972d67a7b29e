// SPDX-License-Identifier: Apache-2.0
/// BlobStore: bytes behind 64-bit keys, kept in one file from run to run: compiled programs and the like.
///   In      a file, who may read it (a hash of device, driver, versions), how large the file may grow.
///   File    little-endian: magic, identity, hash of the rest; then key, size and bytes of every entry. Written beside
///           itself and renamed, so that readers find the old one or the new one and nothing in between.
///   Limits  save() leaves out what this run did not ask for, then the largest, until the rest fits.
///   Thread  one at a time; several processes may use one file, the last to save wins.
///   Fails   what cannot be read, or belongs to something else, counts as empty, with one warning that names the file;
///           what cannot be written is a warning, too. Only std::bad_alloc leaves find() and put() unchanged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <vector>

namespace filament {

class BlobStore {
public:
    BlobStore(std::filesystem::path file, uint64_t identity, uint64_t maxBytes);

    /// Empty if there is none. Valid until put().
    std::span<const std::byte> find(uint64_t key);
    void put(uint64_t key, std::span<const std::byte> bytes);
    void erase(uint64_t key);
    size_t size() const { return mBlobs.size(); }
    /// Nothing if nothing has changed since the file was read.
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

} // namespace filament
