// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/Templates.h"

#include "base/Suggest.h"

#include <algorithm>

namespace filament_core::shader {

Result<std::string> expandTemplates(std::string_view text, std::string_view fileName, TemplateValues const& values) {
    std::string out;
    for (size_t at = 0; at < text.size();) {
        const size_t open = std::min(text.find("${", at), text.size());
        out += text.substr(at, open - at);
        if (open == text.size()) break;
        const auto line = 1 + std::ranges::count(text.substr(0, open), '\n');
        const size_t close = text.find_first_of("}\n", open);
        if (close == std::string_view::npos || text[close] == '\n')
            return fail(ErrorCode::InvalidArgument, "{}:{}: this ${{ has no closing brace", fileName, line);
        const std::string_view name = text.substr(open + 2, close - open - 2);
        const auto value = values.find(name);
        if (value == values.end()) {
            std::vector<std::string_view> known;
            for (auto const& [each, unused] : values) known.push_back(each);
            return fail(ErrorCode::InvalidArgument, "{}:{}: the template name '{}' has no value{}; give -T {}=VALUE",
                        fileName, line, name, suggestion(name, known), name);
        }
        out += value->second;
        at = close + 1;
    }
    return out;
}

} // namespace filament_core::shader
