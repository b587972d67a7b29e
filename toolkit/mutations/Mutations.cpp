// SPDX-License-Identifier: Apache-2.0
#include "toolkit/mutations/Mutations.h"

#include "toolkit/mutations/Edits.h"

#include <algorithm>

namespace filament_core::tools {

std::span<const Mutation> mutations() {
    static const std::vector<Mutation> all = [] {
        std::vector<Mutation> list{ { kNoDefect, "nothing: must not be noticed", make<StreamEdit> } };
        for (const auto subject : { materialMutations(), textureMutations(), lightMutations(), rasterMutations(),
                                    effectMutations(), splatMutations() })
            list.insert(list.end(), subject.begin(), subject.end());
        return list;
    }();
    return all;
}

Mutation const* findMutation(std::string_view name) {
    const auto found = std::ranges::find(mutations(), name, &Mutation::name);
    return found == mutations().end() ? nullptr : &*found;
}

bool isControl(std::string_view name) { return name == kNoDefect || name == kOneList; }

std::vector<std::string_view> mutationNames() {
    std::vector<std::string_view> names;
    for (Mutation const& mutation : mutations()) names.push_back(mutation.name);
    return names;
}

} // namespace filament_core::tools
