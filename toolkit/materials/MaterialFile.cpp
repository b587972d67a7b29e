// SPDX-License-Identifier: Apache-2.0
#include "toolkit/materials/MaterialFile.h"

#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/files/PathInside.h"
#include "toolkit/packages/PackageCache.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>

namespace filament_core::tools {
namespace {

namespace fs = std::filesystem;

std::atomic<uint64_t> gCompiled{ 0 };
std::atomic<bool> gAsksPackageCache{ true };

Result<std::string> readText(fs::path const& path) {
    Result<std::vector<std::byte>> bytes = assets::readFileBytes(path);
    if (!bytes) return bytes.error();
    return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

Result<std::string> edited(std::string text, std::vector<TextEdit> const& edits, std::string const& name) {
    for (auto const& [from, to] : edits) {
        const size_t at = text.find(from);
        if (from.empty() || at == std::string::npos)
            return fail(ErrorCode::NotFound, "{}: there is no '{}' to replace", name, from);
        text.replace(at, from.size(), to);
    }
    return text;
}

/// The latest compilations, by text. A viewer that changes the API or goes back compiles nothing again.
class Compilations {
public:
    /// As long as the files that the text includes are the same.
    std::optional<std::vector<std::byte>> find(std::string const& key, shader::IncludeResolver const& files) {
        const std::lock_guard lock(mMutex);
        const auto entry = std::ranges::find(mEntries, key, &Entry::key);
        if (entry == mEntries.end()) return std::nullopt;
        for (auto const& [name, content] : entry->included)
            if (files(name) != content) return std::nullopt;
        return entry->bytes;
    }
    void add(std::string key, std::map<std::string, std::optional<std::string>> included,
             std::vector<std::byte> bytes) {
        const std::lock_guard lock(mMutex);
        std::erase_if(mEntries, [&](Entry const& entry) { return entry.key == key; });
        if (mEntries.size() == kMost) mEntries.pop_front();
        mEntries.push_back({ std::move(key), std::move(included), std::move(bytes) });
    }
    void clear() {
        const std::lock_guard lock(mMutex);
        mEntries.clear();
    }

private:
    struct Entry {
        std::string key;
        std::map<std::string, std::optional<std::string>> included; ///< contents by name; nothing: there was no file
        std::vector<std::byte> bytes;
    };
    static constexpr size_t kMost = 8;

    std::mutex mMutex;
    std::deque<Entry> mEntries; ///< the newest last
};

Compilations& compilations() {
    static Compilations known;
    return known;
}

constexpr std::string_view kShowMark = "// show:";

/// Without the words about showing it, on which no code depends.
std::string withoutShow(std::string text) {
    const size_t mark = text.find(kShowMark);
    if (mark != std::string::npos) text.erase(mark, text.find('\n', mark) - mark);
    return text;
}

Result<std::vector<std::byte>> compiled(std::string const& text, fs::path const& path, uint16_t filteredVariants) {
    const auto beside = [&](std::string_view name) -> std::optional<std::string> {
        const Result<fs::path> inside = assets::fileInside(path.parent_path(), name);
        if (!inside) return std::nullopt;
        const Result<std::string> file = readText(*inside);
        return file ? std::optional(*file) : std::nullopt;
    };
    std::string key = fmt::format("{}\n{}\n{}", path.string(), filteredVariants, withoutShow(text));
    if (auto bytes = compilations().find(key, beside)) return std::move(*bytes);
    std::map<std::string, std::optional<std::string>> included;
    const auto noted = [&](std::string_view name) { return included[std::string(name)] = beside(name); };
    Result<CompiledPackage> package =
            compilePackage(text, path.filename().string(), { .filteredVariants = filteredVariants, .includes = noted },
                           gAsksPackageCache ? packageCacheOfEnvironment() : std::nullopt);
    if (!package) return package.error();
    if (!package->isKept) gCompiled.fetch_add(1, std::memory_order_relaxed);
    compilations().add(std::move(key), std::move(included), package->bytes);
    return std::move(package->bytes);
}

std::string keyOf(fs::path const& path, std::vector<TextEdit> const& edits, uint16_t filteredVariants) {
    std::string key = fmt::format("{}\n{}", path.string(), filteredVariants);
    for (auto const& [from, to] : edits) key += "\n" + from + "\n" + to;
    return key;
}

} // namespace

Result<MaterialFile> compileMaterialFile(fs::path const& path, std::vector<TextEdit> const& edits,
                                         uint16_t filteredVariants) {
    MaterialFile file{ .name = path.stem().string(), .bytes = {}, .package = {}, .show = {} };
    Result<std::string> text = readText(path);
    if (!text) return text.error();
    if (path.extension() == ".mat") {
        text = edited(std::move(*text), edits, file.name);
        if (!text) return text.error();
        Result<MaterialShow> show = readMaterialShow(*text, path.filename().string());
        if (!show) return show.error();
        file.show = std::move(*show);
        Result<std::vector<std::byte>> bytes = compiled(*text, path, filteredVariants);
        if (!bytes) return bytes.error();
        file.bytes = std::move(*bytes);
    } else {
        const auto bytes = std::as_bytes(std::span(*text));
        file.bytes.assign(bytes.begin(), bytes.end());
    }
    Result<shader::MaterialPackage> package = shader::readPackage(file.bytes);
    if (!package) return fail(package.error().code, "{}: {}", path.string(), package.error().message);
    file.package = std::move(*package);
    return file;
}

uint64_t compiledMaterialFiles() { return gCompiled.load(std::memory_order_relaxed); }

void forgetCompiledMaterialFiles() {
    compilations().clear();
    gAsksPackageCache = false;
}

bool isMaterialFile(fs::path const& path) { return path.extension() == ".mat" || path.extension() == ".fmat"; }

Result<MaterialShow> readMaterialShow(std::string_view text, std::string_view fileName) {
    MaterialShow show;
    const size_t mark = text.find(kShowMark);
    if (mark == std::string_view::npos) return show;
    const size_t begin = mark + kShowMark.size();
    std::istringstream words(std::string(text.substr(begin, text.find('\n', begin) - begin)));
    for (std::string word; words >> word;) {
        const size_t equals = word.find('=');
        if (equals == 0 || equals == std::string::npos)
            return fail(ErrorCode::InvalidArgument, "{}: '{}' after '// show:' is not name=value", fileName, word);
        std::string name = word.substr(0, equals), value = word.substr(equals + 1);
        if (name == "mesh")
            show.mesh = value;
        else if (name == "slab")
            show.slab = value == "true";
        else if (name == "instances")
            show.instances = static_cast<uint32_t>(std::clamp(std::atoi(value.c_str()), 1, 16));
        else
            show.values.emplace_back(std::move(name), std::move(value));
    }
    return show;
}

Result<std::shared_ptr<const MaterialFile>> readMaterialFile(fs::path const& path, std::vector<TextEdit> const& edits,
                                                             uint16_t filteredVariants) {
    static std::mutex mutex;
    static std::map<std::string, std::shared_ptr<const MaterialFile>> known;
    const std::lock_guard lock(mutex);
    std::shared_ptr<const MaterialFile>& entry = known[keyOf(path, edits, filteredVariants)];
    if (!entry) {
        Result<MaterialFile> file = compileMaterialFile(path, edits, filteredVariants);
        if (!file) return file.error();
        entry = std::make_shared<const MaterialFile>(std::move(*file));
    }
    return entry;
}

} // namespace filament_core::tools
