// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/RecentFiles.h"

#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/json/JsonFile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <span>

namespace filament_core::view {
namespace {

constexpr size_t kLongestStore = size_t{ 1 } << 20;
constexpr const char* kStoreName = "filament-view/recent.json";

bool isAbsolutePath(std::string_view text) {
    const auto isPlain = [](char c) { return static_cast<unsigned char>(c) >= ' ' && c != 0x7f; };
    return text.starts_with('/') && text.size() <= kLongestPath && std::ranges::all_of(text, isPlain);
}

std::filesystem::path absoluteFolder(const char* variable) {
    const char* text = std::getenv(variable);
    return text && isAbsolutePath(text) ? std::filesystem::path(text) : std::filesystem::path();
}

void addUnlessKnown(std::vector<std::filesystem::path>& files, std::filesystem::path file) {
    if (files.size() < kMostRecent && std::ranges::find(files, file) == files.end()) files.push_back(std::move(file));
}

} // namespace

std::filesystem::path recentFilesPath() {
    if (const std::filesystem::path state = absoluteFolder("XDG_STATE_HOME"); !state.empty()) return state / kStoreName;
    const std::filesystem::path home = absoluteFolder("HOME");
    return home.empty() ? home : home / ".local/state" / kStoreName;
}

std::vector<std::filesystem::path> recentFromJson(std::string_view text) {
    const Result<tools::Json> json = tools::parseJson(text, {});
    std::vector<std::filesystem::path> files;
    if (!json || !json->is_array()) return files;
    for (tools::Json const& each : *json) {
        if (each.is_string() && isAbsolutePath(each.get_ref<std::string const&>()))
            addUnlessKnown(files, each.get<std::string>());
    }
    return files;
}

std::string recentToJson(std::vector<std::filesystem::path> const& files) {
    tools::Json json = tools::Json::array();
    for (std::filesystem::path const& file : files) json.push_back(file.string());
    return tools::jsonText(json);
}

RecentFiles::RecentFiles(std::filesystem::path store) : mStore(std::move(store)) { read(); }

void RecentFiles::read() {
    if (mStore.empty()) return;
    std::error_code error;
    if (!std::filesystem::is_regular_file(mStore, error)) return; // a pipe would wait
    const Result<std::string> text = assets::readText(mStore, kLongestStore);
    if (text) mFiles = recentFromJson(*text);
}

Result<void> RecentFiles::add(std::filesystem::path const& file) {
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::absolute(file, error).lexically_normal();
    if (error || !isAbsolutePath(whole.string())) return {}; // a name that the list cannot hold
    read();
    std::vector<std::filesystem::path> files{ whole };
    for (std::filesystem::path& each : mFiles) addUnlessKnown(files, std::move(each));
    mFiles = std::move(files);
    if (mStore.empty()) return {};
    const std::string text = recentToJson(mFiles);
    return assets::replaceFile(mStore, std::as_bytes(std::span(text)));
}

} // namespace filament_core::view
