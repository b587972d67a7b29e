// SPDX-License-Identifier: Apache-2.0
#include "tools/view/stage/FileWatch.h"

#include "base/Result.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/files/PathInside.h"
#include "filament_core/assets/gltf/GltfUri.h"
#include "toolkit/json/JsonFile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <string_view>

namespace filament_core::view {
namespace {

namespace fs = std::filesystem;

std::string textOfFile(fs::path const& file) {
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(file);
    return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : std::string();
}

/// RFC 3986, 2.1: %20 is a space.
std::string decoded(std::string_view uri) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9' ? c - '0' : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10 : -1;
    };
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        const int high = uri[i] == '%' && i + 2 < uri.size() ? digit(uri[i + 1]) : -1,
                  low = high >= 0 ? digit(uri[i + 2]) : -1;
        text += low >= 0 ? static_cast<char>(high * 16 + low) : uri[i];
        if (low >= 0) i += 2;
    }
    return text;
}

void addUris(tools::Json const& tree, const char* list, fs::path const& folder, std::vector<fs::path>& files) {
    const auto found = tree.find(list);
    if (found == tree.end() || !found->is_array()) return;
    for (tools::Json const& element : *found) {
        const auto uri = element.is_object() ? element.find("uri") : element.end();
        if (!element.is_object() || uri == element.end() || !uri->is_string()) continue;
        const std::string text = uri->get<std::string>();
        if (!assets::isDataUri(text)) files.push_back(folder / decoded(text));
    }
}

std::string_view withoutSpaces(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
}

/// The names in #include "..." and #include <...>. A regular expression of the standard library needs a call for each
/// character of a long name.
std::vector<std::string_view> includesOf(std::string_view text) {
    constexpr std::string_view kInclude = "include";
    std::vector<std::string_view> names;
    for (size_t at = text.find('#'); at != std::string_view::npos; at = text.find('#', at + 1)) {
        std::string_view rest = withoutSpaces(text.substr(at + 1));
        if (!rest.starts_with(kInclude)) continue;
        rest = withoutSpaces(rest.substr(kInclude.size()));
        if (rest.empty() || (rest[0] != '"' && rest[0] != '<')) continue;
        rest.remove_prefix(1);
        const size_t end = rest.find_first_of("\">\n");
        if (end != std::string_view::npos && end > 0 && rest[end] != '\n') names.push_back(rest.substr(0, end));
    }
    return names;
}

} // namespace

std::vector<fs::path> filesOf(fs::path const& file) {
    std::vector<fs::path> files{ file };
    if (file.extension() == ".gltf") {
        const Result<tools::Json> tree = tools::readJson(file);
        if (!tree || !tree->is_object()) return files;
        addUris(*tree, "buffers", file.parent_path(), files);
        addUris(*tree, "images", file.parent_path(), files);
    } else if (file.extension() == ".mat") {
        const std::string text = textOfFile(file);
        for (const std::string_view name : includesOf(text)) {
            const Result<fs::path> inside = assets::fileInside(file.parent_path(), std::string(name));
            if (inside) files.push_back(*inside);
        }
    }
    return files;
}

FileWatch::State FileWatch::stateOf(fs::path const& file) {
    std::error_code error;
    const auto time = fs::last_write_time(file, error);
    if (error) return {};
    const uintmax_t size = fs::file_size(file, error);
    return { .exists = true, .time = time.time_since_epoch().count(), .size = error ? 0 : size };
}

void FileWatch::watch(std::vector<fs::path> const& files) {
    std::map<fs::path, Watched> watched;
    for (fs::path const& file : files) {
        if (file.empty()) continue;
        const auto known = mFiles.find(file);
        const State now = stateOf(file);
        watched[file] = known == mFiles.end() ? Watched{ now, now } : known->second;
    }
    mFiles = std::move(watched);
}

std::vector<fs::path> FileWatch::changed() {
    std::vector<fs::path> changed;
    for (auto& [file, watched] : mFiles) {
        const State now = stateOf(file);
        const bool isSettled = now == watched.seen;
        watched.seen = now;
        if (!isSettled || now == watched.known) continue;
        watched.known = now;
        changed.push_back(file);
    }
    return changed;
}

} // namespace filament_core::view
