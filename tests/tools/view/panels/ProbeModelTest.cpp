// SPDX-License-Identifier: Apache-2.0
// What the panel of probes does to a document.
#include "tools/view/panels/ProbeModel.h"

#include <gmock/gmock.h>

namespace filament_core::view {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

TEST(ProbeModel, ANewProbeFillsTheBoxAndHasANameOfItsOwn) {
    Document document;
    addProbe(document, { { -1, 0, -2 }, { 3, 4, 2 } });
    EXPECT_EQ(document.probes.back().centerWorld, double3(1, 2, 0));
    EXPECT_EQ(document.probes.back().halfExtentMeters, float3(2));
    addProbe(document, {});
    copyProbe(document, 0);
    document.probes.erase(document.probes.begin());
    addProbe(document, { { 0, 0, 0 }, { 1, 0, 1 } }); // flat
    EXPECT_TRUE(check(document)) << check(document).error().message;
    for (size_t i = 0; i < document.probes.size(); ++i) {
        for (size_t j = 0; j < i; ++j) EXPECT_NE(document.probes[i].name, document.probes[j].name);
    }
}

TEST(ProbeModel, OnlyLinesOfProbesAndGridsAreShown) {
    EXPECT_THAT(probeLines("bloom: off\nreflection probes: 1 of 2\nreflection probe room: used\n"
                           "irradiance grids: none\nshadows: on"),
                ElementsAre(StartsWith("reflection probes"), StartsWith("reflection probe room"),
                            StartsWith("irradiance grids")));
    EXPECT_TRUE(probeLines("").empty());
}

} // namespace
} // namespace filament_core::view
