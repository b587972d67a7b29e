// SPDX-License-Identifier: Apache-2.0
#include "toolkit/packages/PackageCache.h"

#include "base/Hash.h"
#include "filament_core/assets/files/FileBytes.h"
#include "shaders/package/ByteReader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <mutex>
#include <system_error>

namespace filament_core::tools {
namespace {

namespace fs = std::filesystem;
using shader::ByteReader;
using shader::CompileOptions;
using shader::IncludeResolver;

/// By name; no contents: there was no such file.
using Included = std::map<std::string, std::optional<std::string>, std::less<>>;

std::string keyOf(std::string_view text, std::string_view fileName, CompileOptions const& options,
                  PackageCache const& cache) {
    // Names every member: an option that is added and forgotten here does not compile.
    auto const& [exact, optimization, spirv, essl, platform, filteredVariants, onlyVariant, includes, jobs, defines,
                 warnings] = options;
    std::string key =
            fmt::format("{}\n{} {} {} {} {} {} {}\n{}\n", cache.compiler, exact, static_cast<int>(optimization), spirv,
                        essl, static_cast<int>(platform), filteredVariants, onlyVariant ? *onlyVariant : -1, fileName);
    for (auto const& [name, value] : defines) key += fmt::format("{} {}\n", name, value);
    return key.append("\n").append(text);
}

void appendWord(std::vector<std::byte>& out, uint32_t word) {
    const size_t at = out.size();
    out.resize(at + sizeof(word));
    for (int i = 0; i < 4; ++i) out[at + i] = static_cast<std::byte>(word >> 8 * i);
}

void appendBytes(std::vector<std::byte>& out, std::span<const std::byte> bytes) {
    appendWord(out, static_cast<uint32_t>(bytes.size()));
    out.insert(out.end(), bytes.begin(), bytes.end());
}

void appendText(std::vector<std::byte>& out, std::string_view text) {
    appendBytes(out, std::as_bytes(std::span(text)));
}

uint32_t checksumOf(std::span<const std::byte> bytes) { return static_cast<uint32_t>(hashBytes(bytes)); }

/// checksum of the rest; key; number of included files, each: name, whether there was one, contents; package
std::vector<std::byte> encode(std::string_view key, Included const& included, std::span<const std::byte> package) {
    std::vector<std::byte> rest;
    appendText(rest, key);
    appendWord(rest, static_cast<uint32_t>(included.size()));
    for (auto const& [name, contents] : included) {
        appendText(rest, name);
        appendWord(rest, contents.has_value());
        appendText(rest, contents.value_or(""));
    }
    appendBytes(rest, package);
    std::vector<std::byte> entry;
    appendWord(entry, checksumOf(rest));
    entry.insert(entry.end(), rest.begin(), rest.end());
    return entry;
}

/// The package, if the entry is whole, has this key, and the files that it includes are what they were.
std::optional<std::vector<std::byte>> decode(std::span<const std::byte> entry, std::string_view key,
                                             IncludeResolver const& includes) {
    ByteReader in(entry);
    const uint32_t checksum = in.u32();
    if (in.failed() || checksum != checksumOf(entry.subspan(sizeof(checksum))) || in.text() != key) return std::nullopt;
    for (uint32_t left = in.u32(); left > 0 && !in.failed(); --left) {
        const std::string name = in.text();
        const bool exists = in.u32() != 0;
        const std::string contents = in.text();
        const std::optional<std::string> now = includes ? includes(name) : std::nullopt;
        if (now.has_value() != exists || now.value_or("") != contents) return std::nullopt;
    }
    const auto package = in.bytes(in.u32());
    if (in.failed() || !in.atEnd()) return std::nullopt;
    return std::vector<std::byte>(package.begin(), package.end());
}

struct File {
    fs::path path;
    fs::file_time_type used;
    uint64_t bytes = 0;
};

/// Deletes the files that were used longest ago. Another process may do so, too: what fails is left.
void shrink(fs::path const& folder, uint64_t maxBytes) {
    std::vector<File> files;
    uint64_t total = 0;
    std::error_code failed;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
        std::error_code gone;
        File file{ at->path(), at->last_write_time(gone), 0 };
        if (!gone) file.bytes = at->file_size(gone);
        if (gone) continue;
        total += file.bytes;
        files.push_back(std::move(file));
    }
    if (total <= maxBytes) return;
    std::ranges::sort(files, {}, &File::used);
    for (File const& file : files) {
        if (total <= maxBytes / 4 * 3) break; // not again at the next one
        fs::remove(file.path, failed);
        total -= file.bytes;
    }
}

void keep(PackageCache const& cache, fs::path const& path, std::span<const std::byte> entry) {
    if (!assets::replaceFile(path, entry)) return;
    assets::removeLeftovers(cache.folder);
    shrink(cache.folder, cache.maxBytes);
}

Result<std::vector<std::byte>> compile(std::string_view text, std::string_view fileName,
                                       CompileOptions const& options) {
    const Result<shader::MaterialPackage> package = shader::compileMaterial(text, fileName, options);
    if (!package) return package.error();
    return shader::writePackage(*package);
}

} // namespace

std::optional<PackageCache> packageCacheOfEnvironment() {
    const char* const folder = std::getenv("FILAMENT_PACKAGE_CACHE");
    if (!folder || !*folder) return std::nullopt;
    return PackageCache{ .folder = folder, .compiler = std::string(compilerIdentity()) };
}

Result<CompiledPackage> compilePackage(std::string_view text, std::string_view fileName, CompileOptions const& options,
                                       std::optional<PackageCache> const& cache) {
    if (!cache || options.warnings) {
        Result<std::vector<std::byte>> bytes = compile(text, fileName, options);
        if (!bytes) return bytes.error();
        return CompiledPackage{ .bytes = std::move(*bytes) };
    }
    const std::string key = keyOf(text, fileName, options, *cache);
    const fs::path path = cache->folder / fmt::format("{:016x}", hashString(key));
    if (const auto entry = assets::readFileBytes(path)) {
        if (auto package = decode(*entry, key, options.includes)) {
            std::error_code ignored;
            fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
            return CompiledPackage{ .bytes = std::move(*package), .isKept = true };
        }
    }
    Included included;
    std::mutex mutex; // jobs ask at the same time
    CompileOptions noting = options;
    noting.includes = [&](std::string_view name) {
        const std::lock_guard lock(mutex);
        return included[std::string(name)] = options.includes ? options.includes(name) : std::nullopt;
    };
    Result<std::vector<std::byte>> bytes = compile(text, fileName, noting);
    if (!bytes) return bytes.error();
    keep(*cache, path, encode(key, included, *bytes));
    return CompiledPackage{ .bytes = std::move(*bytes) };
}

} // namespace filament_core::tools
