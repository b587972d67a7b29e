// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Row.h"

namespace filament_core::shader::numerics {

std::span<const Row> rows() {
    static const std::vector<Row> all = [] {
        std::vector<Row> joined;
        for (auto const& source :
             { mathRows(), brdfRows(), layerRows(), scatterRows(), detailRows(), colorRows(), imageRows(), areaRows(),
               geometryRows(), screenRows(), temporalRows(), gradingRows(), toneRows(), resolutionRows(),
               transparencyRows(), splatRows(), probeRows(), fieldRows() })
            joined.insert(joined.end(), source.begin(), source.end());
        return joined;
    }();
    return all;
}

} // namespace filament_core::shader::numerics
