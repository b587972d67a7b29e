// SPDX-License-Identifier: Apache-2.0
// The defaults lie on the measured Pareto front: no other value of a choice has less error and costs no more. No
// device.
#include <filament_core/Options.h>
#include <filament_core/Quality.h>
#include <filament_core/QualityCosts.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace filament_core {
namespace {

constexpr double kNoSlower = 1.02;  // of the time of the default: what a table of busy machines can tell apart
constexpr double kLessError = 1e-3; // of the image's luminance, a quarter of a step of 8 bits

double ratioOn(Backend backend, QualityCost const& other, QualityCost const& standard) {
    return other.on(backend).milliseconds / standard.on(backend).milliseconds;
}

bool dominates(QualityCost const& other, QualityCost const& standard) {
    return other.error < standard.error - kLessError && ratioOn(Backend::Vulkan, other, standard) <= kNoSlower &&
           ratioOn(Backend::Gles, other, standard) <= kNoSlower;
}

TEST(QualityDefaults, AreDominatedByNoOtherValueOfTheLibrarysTable) {
    for (QualityEffect const& effect : defaultQualityCosts().effects) {
        const std::string name = *optionValue(Quality{}, effect.name);
        const auto standard = std::ranges::find(effect.values, name, &QualityCost::value);
        ASSERT_NE(standard, effect.values.end()) << effect.name << '=' << name;
        for (QualityCost const& other : effect.values) {
            EXPECT_FALSE(dominates(other, *standard))
                    << effect.name << '=' << other.value << " has error " << other.error << " where the default, "
                    << name << ", has " << standard->error << ", and takes "
                    << ratioOn(Backend::Vulkan, other, *standard) << " and " << ratioOn(Backend::Gles, other, *standard)
                    << " of its time; make it the default, or measure again";
        }
    }
}

TEST(QualityDefaults, OfEveryChoiceAreInTheTable) {
    for (Option const& choice : optionsOf<Quality>()) {
        EXPECT_TRUE(std::ranges::any_of(defaultQualityCosts().effects,
                                        [&](QualityEffect const& effect) { return effect.name == choice.name; }))
                << choice.name << ": measure with filament-render --measure-costs";
    }
}

TEST(QualityDefaults, ADominatedOneIsNoticed) {
    const auto cost = [](double error, double milliseconds) {
        return QualityCost{ .value = "", .error = error, .vulkan = { milliseconds }, .gles = { milliseconds } };
    };
    EXPECT_TRUE(dominates(cost(0.02, 10), cost(0.1, 10)));
    EXPECT_TRUE(dominates(cost(0.02, 9), cost(0.1, 10)));
    EXPECT_FALSE(dominates(cost(0.02, 11), cost(0.1, 10))) << "more exact, and slower";
    EXPECT_FALSE(dominates(cost(0.1, 5), cost(0.1, 10))) << "faster, and no more exact";
}

} // namespace
} // namespace filament_core
