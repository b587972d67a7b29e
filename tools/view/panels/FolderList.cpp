// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/FolderList.h"

#include "base/Utf8.h"
#include "tools/view/panels/PanelText.h"

#include <algorithm>
#include <cctype>
#include <optional>

namespace filament_core::view {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// The digits from `at`, without leading zeros.
std::string_view digitsFrom(std::string_view text, size_t at) {
    size_t end = at;
    while (end < text.size() && isDigit(text[end])) ++end;
    while (at + 1 < end && text[at] == '0') ++at;
    return text.substr(at, end - at);
}

/// Negative: a is before b. Equal for names that differ in case or in leading zeros alone.
int naturalOrder(std::string_view a, std::string_view b) {
    size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
        if (isDigit(a[i]) && isDigit(b[j])) {
            const std::string_view x = digitsFrom(a, i), y = digitsFrom(b, j);
            if (x.size() != y.size()) return x.size() < y.size() ? -1 : 1;
            if (const int order = x.compare(y); order != 0) return order;
            i = static_cast<size_t>(x.data() + x.size() - a.data());
            j = static_cast<size_t>(y.data() + y.size() - b.data());
            continue;
        }
        const auto x = static_cast<unsigned char>(lower(a[i++])), y = static_cast<unsigned char>(lower(b[j++]));
        if (x != y) return x < y ? -1 : 1;
    }
    return static_cast<int>(a.size() - i > 0) - static_cast<int>(b.size() - j > 0);
}

std::optional<FolderEntry> entryOf(std::filesystem::directory_entry const& each,
                                   std::span<const std::string_view> endings) {
    FolderEntry entry{ .name = each.path().filename().string() };
    if (entry.name.empty() || entry.name.front() == '.') return std::nullopt;
    std::error_code error;
    entry.isFolder = each.is_directory(error);
    if (entry.isFolder) return entry;
    if (!each.is_regular_file(error) || error || !endsAsAsked(entry.name, endings)) return std::nullopt;
    const uintmax_t bytes = each.file_size(error);
    entry.bytes = error ? 0 : bytes;
    return entry;
}

/// How many bytes a character of UTF-8 has that begins here; 0: none does, or it is a control character.
size_t bytesOfCharacter(std::string_view text) {
    const auto first = static_cast<unsigned char>(text[0]);
    return first < 0x20 || first == 0x7f ? 0 : utf8Length(text);
}

} // namespace

PathKind kindOfPath(std::filesystem::path const& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) return PathKind::Missing;
    if (std::filesystem::is_directory(status)) return PathKind::Folder;
    return std::filesystem::is_regular_file(status) ? PathKind::File : PathKind::Other;
}

bool endsAsAsked(std::string name, std::span<const std::string_view> endings) {
    std::ranges::transform(name, name.begin(), lower);
    return endings.empty() ||
           std::ranges::any_of(endings, [&](std::string_view ending) { return name.ends_with(ending); });
}

bool comesBefore(FolderEntry const& a, FolderEntry const& b) {
    if (a.isFolder != b.isFolder) return a.isFolder;
    const int order = naturalOrder(a.name, b.name);
    return order != 0 ? order < 0 : a.name < b.name;
}

FolderList listFolder(std::filesystem::path const& folder, std::span<const std::string_view> endings) {
    FolderList list;
    std::error_code error;
    std::filesystem::directory_iterator each(folder, error);
    for (; !error && each != std::filesystem::directory_iterator(); each.increment(error)) {
        std::optional<FolderEntry> entry = entryOf(*each, endings);
        if (!entry) continue;
        list.isCut = list.entries.size() == kMostEntries;
        if (list.isCut) break;
        list.entries.push_back(std::move(*entry));
    }
    if (error) list.error = "cannot be read: " + error.message();
    std::ranges::sort(list.entries, comesBefore);
    return list;
}

std::vector<size_t> matching(std::vector<FolderEntry> const& entries, std::string_view filter) {
    std::vector<size_t> places;
    for (size_t i = 0; i < entries.size(); ++i)
        if (matchesFilter(entries[i].name, filter)) places.push_back(i);
    return places;
}

std::string shownName(std::string_view name) {
    std::string shown;
    while (!name.empty()) {
        const size_t bytes = bytesOfCharacter(name);
        shown += bytes > 0 ? name.substr(0, bytes) : std::string_view("?");
        name.remove_prefix(std::max<size_t>(bytes, 1));
    }
    return shown;
}

} // namespace filament_core::view
