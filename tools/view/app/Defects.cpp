// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/Defects.h"

#include "tools/conformance/Mutations.h"

namespace filament::view {

std::vector<OfferedDefect> defectsFor(Backend backend) {
    std::vector<OfferedDefect> offered;
    for (conformance::Mutation const& mutation : conformance::mutations()) {
        if (mutation.fits(backend) && !conformance::isControl(mutation.name))
            offered.push_back({ std::string(mutation.name), std::string(mutation.what) });
    }
    return offered;
}

std::shared_ptr<backend::FrameCapture> injected(std::string_view defect) {
    conformance::Mutation const* mutation = conformance::findMutation(defect);
    return mutation ? std::make_shared<backend::FrameCapture>(mutation->make()) : nullptr;
}

std::string whatOf(std::string_view defect) {
    conformance::Mutation const* mutation = conformance::findMutation(defect);
    return std::string(mutation ? mutation->what : defect);
}

} // namespace filament::view
