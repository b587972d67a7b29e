// SPDX-License-Identifier: Apache-2.0
#include "tools/tables/Tables.h"

#include "filament_core/assets/gltf/GltfExtensions.h"
#include "shaders/compiler/LanguageTables.h"
#include "toolkit/program/SceneChoices.h"

#include <filament_core/View.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace filament_core::tools {
namespace {

constexpr std::string_view kBegin = "<!-- begin: ", kEnd = "<!-- end: ", kClose = " -->";

constexpr const char* kOptionHead = "| name | values | initially | effect |\n|---|---|---|---|\n";

std::string optionRow(Option const& option, void const* standard, std::string_view prefix = {}) {
    return fmt::format("| `{}{}` | {} | `{}` | {} |\n", prefix, option.name, rangeOf(option),
                       optionValue(option, standard), option.description);
}

/// The options of T, with the values of one that nobody changed.
template <class T>
std::string optionTable() {
    const T standard{};
    std::string text = kOptionHead;
    for (Option const& option : optionsOf<T>()) text += optionRow(option, &standard);
    return text;
}

/// What View itself has.
std::string viewTable() {
    const View standard;
    std::string text = kOptionHead;
    for (Option const& option : optionsOf<View>()) {
        const bool isOfMember = findOption(optionsOf<Quality>(), option.name) ||
                                findOption(optionsOf<Effects>(), option.name) ||
                                findOption(optionsOf<DisplayTransform>(), option.name);
        if (!isOfMember) text += optionRow(option, &standard);
    }
    return text;
}

/// What command lines have besides the options of a view.
std::string choiceTable() {
    std::string text = kOptionHead;
    text += "| `exact` | off or on | `on` | Off leaves arithmetic to the drivers: the bits then differ. |\n"
            "| `bloom.dirt` | a file | | Dirt of the lens, through which [bloom](bloom.md) is seen. |\n";
    for (PrefixedOptions const& set : prefixedOptions())
        for (Option const& option : set.options) text += optionRow(option, set.defaults, set.prefix);
    return text;
}

std::string_view nameOf(assets::GltfExtensionState state) {
    constexpr std::array kNames{ "ratified", "release candidate", "vendor", "draft", "archived" };
    return kNames[static_cast<size_t>(state)];
}

std::string extensionTable() {
    std::string text = "| extension | state, November 2026 | what the engine makes of it |\n|---|---|---|\n";
    for (assets::GltfExtension const& extension : assets::gltfExtensions())
        fmt::format_to(std::back_inserter(text), "| `{}` | {} | {} |\n", extension.name, nameOf(extension.state),
                       extension.effect);
    return text;
}

Error wrongMark(std::string_view document, size_t at, std::string_view name, std::string const& reason) {
    const auto line = 1 + std::ranges::count(document.substr(0, at), '\n');
    return fail(ErrorCode::InvalidArgument, "{}:{}: {}", name, line, reason);
}

/// "NAME" of the mark whose prefix ends at `at`.
std::string_view markName(std::string_view document, size_t at) {
    const size_t end = document.find(kClose, at);
    return document.substr(at, end == std::string_view::npos ? 0 : end - at);
}

} // namespace

std::vector<NamedTable> documentTables() {
    std::vector<NamedTable> tables = shader::languageTables();
    tables.emplace_back("quality-choices", optionTable<Quality>());
    tables.emplace_back("effect-options", optionTable<Effects>());
    tables.emplace_back("grading-options", optionTable<DisplayTransform>());
    tables.emplace_back("view-options", viewTable());
    tables.emplace_back("scene-choices", choiceTable());
    tables.emplace_back("gltf-extensions", extensionTable());
    return tables;
}

Result<std::string> withTables(std::string_view document, std::vector<NamedTable> const& tables,
                               std::string_view name) {
    std::string out;
    size_t copied = 0;
    for (size_t at = document.find(kBegin); at != std::string_view::npos; at = document.find(kBegin, copied)) {
        const std::string_view table = markName(document, at + kBegin.size());
        const auto known = std::ranges::find(tables, table, &NamedTable::first);
        if (known == tables.end()) return wrongMark(document, at, name, fmt::format("there is no table '{}'", table));
        const std::string begin = fmt::format("{}{}{}\n", kBegin, table, kClose);
        const std::string end = fmt::format("{}{}{}", kEnd, table, kClose);
        const size_t to = document.find(end, at);
        if (!document.substr(at).starts_with(begin) || to == std::string_view::npos)
            return wrongMark(
                    document, at, name,
                    fmt::format("the table needs a line '{}' and then '{}'", begin.substr(0, begin.size() - 1), end));
        out += document.substr(copied, at - copied);
        out += begin + known->second + end;
        copied = to + end.size();
    }
    out += document.substr(copied);
    return out;
}

} // namespace filament_core::tools
