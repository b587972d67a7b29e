// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/Defects.h"

#include "toolkit/mutations/Mutations.h"

namespace filament_core::view {

std::vector<OfferedDefect> defectsFor(Backend backend) {
    std::vector<OfferedDefect> offered;
    for (tools::Mutation const& mutation : tools::mutations()) {
        if (mutation.fits(backend) && !tools::isControl(mutation.name))
            offered.push_back({ std::string(mutation.name), std::string(mutation.what) });
    }
    return offered;
}

std::shared_ptr<backend::FrameCapture> injected(std::string_view defect) {
    tools::Mutation const* mutation = tools::findMutation(defect);
    return mutation ? std::make_shared<backend::FrameCapture>(mutation->make()) : nullptr;
}

std::string whatOf(std::string_view defect) {
    tools::Mutation const* mutation = tools::findMutation(defect);
    return std::string(mutation ? mutation->what : defect);
}

} // namespace filament_core::view
