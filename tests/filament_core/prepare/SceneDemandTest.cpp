// SPDX-License-Identifier: Apache-2.0
// Demand as a pure function, and as what prepareFrame() finds in scenes: without a device.
#include "filament_core/prepare/SceneDemand.h"

#include <gtest/gtest.h>

namespace filament::prepare {
namespace {

SceneDemand demandOf(ViewCounts const& counts) { return findDemand({ .counts = counts }); }

TEST(SceneDemand, OfAnEmptySceneIsNothing) {
    for (EffectDemand const& effect : findDemand({}).effects) {
        EXPECT_FALSE(effect.isNeeded);
        EXPECT_EQ(effect.reason, DemandReason::NotInScene);
    }
}

TEST(SceneDemand, NeedsLightOnlyWhereItMeetsALitSurface) {
    ViewCounts counts{ .lights = 2, .suns = 1, .litDraws = 1 };
    const Effect lights[] = { Effect::Sun, Effect::LightList, Effect::IndirectLight };
    SceneDemand demand = findDemand({ .counts = counts, .hasIndirectLight = true });
    for (const Effect effect : lights) EXPECT_TRUE(demand.needs(effect)) << nameOf(effect);
    counts.litDraws = 0;
    demand = findDemand({ .counts = counts, .hasIndirectLight = true });
    for (const Effect effect : lights) {
        EXPECT_FALSE(demand.needs(effect)) << nameOf(effect);
        EXPECT_EQ(demand.of(effect).reason, DemandReason::NothingLitVisible) << nameOf(effect);
    }
}

TEST(SceneDemand, TellsLightsOutOfViewFromNone) {
    EXPECT_EQ(demandOf({ .litDraws = 1 }).of(Effect::LightList).reason, DemandReason::NotInScene);
    const SceneDemand demand = demandOf({ .lightsOutOfView = 3, .litDraws = 1 });
    EXPECT_EQ(demand.of(Effect::LightList), (EffectDemand{ false, DemandReason::OutOfView, 0, 3 }));
    EXPECT_EQ(describe(Effect::LightList, demand.of(Effect::LightList)), "none of 3 reaches into the view");
}

TEST(SceneDemand, CountsWhatIsLeftOut) {
    const SceneDemand demand =
            demandOf({ .lights = 4, .lightsOutOfView = 1, .lightsOverLimit = 2, .suns = 3, .litDraws = 1 });
    EXPECT_EQ(describe(Effect::LightList, demand.of(Effect::LightList)), "4 of 7 shine on what is visible");
    EXPECT_EQ(describe(Effect::Sun, demand.of(Effect::Sun)), "the brightest of 3; the others are in the light list");
}

TEST(SceneDemand, OfEachEffectChangesWithItsOwnCauseAlone) {
    const DemandInput nothing{ .counts = { .litDraws = 1 } };
    const auto changed = [&](DemandInput const& input) {
        std::vector<Effect> effects;
        for (size_t i = 0; i < kEffects; ++i) {
            const auto effect = static_cast<Effect>(i);
            if (findDemand(input).of(effect) != findDemand(nothing).of(effect)) effects.push_back(effect);
        }
        return effects;
    };
    EXPECT_EQ(changed({ .counts = { .suns = 1, .litDraws = 1 } }), std::vector{ Effect::Sun });
    EXPECT_EQ(changed({ .counts = { .lights = 1, .litDraws = 1 } }), std::vector{ Effect::LightList });
    EXPECT_EQ(changed({ .counts = { .litDraws = 1 }, .hasIndirectLight = true }), std::vector{ Effect::IndirectLight });
    EXPECT_EQ(changed({ .counts = { .litDraws = 1 }, .hasSky = true }), std::vector{ Effect::Sky });
    EXPECT_EQ(changed({ .counts = { .litDraws = 1, .blendedDraws = 1 } }), std::vector{ Effect::Blending });
    EXPECT_EQ(changed({ .counts = { .litDraws = 1 }, .deformed = 1 }), std::vector{ Effect::Deformation });
}

TEST(SceneDemand, HasWordsForEveryReasonOfEveryEffect) {
    for (size_t i = 0; i < kEffects; ++i) {
        for (const auto reason :
             { DemandReason::ReachesLitSurfaces, DemandReason::IsVisible, DemandReason::FillsBackground,
               DemandReason::NotInScene, DemandReason::OutOfView, DemandReason::NothingLitVisible }) {
            const auto effect = static_cast<Effect>(i);
            EXPECT_FALSE(describe(effect, { .reason = reason, .count = 1, .others = 1 }).empty());
            EXPECT_NE(std::string(nameOf(effect)), "");
        }
    }
}

} // namespace
} // namespace filament::prepare
