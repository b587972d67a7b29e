// SPDX-License-Identifier: Apache-2.0
#include <filament_core/EnumNames.h>

namespace filament_core {

std::string listed(std::span<const std::string_view> names) {
    std::string text;
    for (size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
        text += names[i];
    }
    return text;
}

} // namespace filament_core
