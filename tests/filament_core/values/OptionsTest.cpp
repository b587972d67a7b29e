// SPDX-License-Identifier: Apache-2.0
// Options: every one of every type is read back as written, its limits hold, and nothing else is accepted.
#include <filament_core/Options.h>
#include <filament_core/View.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>

namespace filament_core {
namespace {

template <class T>
class OptionsOf : public testing::Test {};
using Types = testing::Types<View, Quality, Effects, DisplayTransform>;
TYPED_TEST_SUITE(OptionsOf, Types);

std::string repeated(Option const& option, double number) {
    std::string text;
    for (int i = 0; i < option.components; ++i) text += (i ? "," : "") + fmt::format("{}", number);
    return text;
}

/// The nearest number of the field's type on the other side of a limit.
double beyond(Option const& option, double limit, double direction) {
    if (option.kind == OptionKind::Integer) return limit + direction;
    if (option.storage != Option::Storage::Float) return std::nextafter(limit, direction * INFINITY);
    const auto number = static_cast<float>(limit), infinity = static_cast<float>(direction) * INFINITY;
    return static_cast<double>(std::nextafter(number, infinity));
}

TYPED_TEST(OptionsOf, HaveNamesOfTheirOwnAndADescription) {
    std::set<std::string_view> names;
    for (Option const& option : optionsOf<TypeParam>()) {
        EXPECT_TRUE(names.insert(option.name).second) << option.name;
        EXPECT_TRUE(option.description.ends_with('.')) << option.name;
        EXPECT_FALSE(rangeOf(option).empty()) << option.name;
    }
}

TYPED_TEST(OptionsOf, AreReadBackAsTheyWereSet) {
    for (Option const& option : optionsOf<TypeParam>()) {
        for (const std::string_view value : option.values) {
            TypeParam object;
            ASSERT_TRUE(setOption(object, option.name, value)) << option.name << '=' << value;
            EXPECT_EQ(optionValue(object, option.name), value);
        }
        TypeParam object;
        const std::string value = *optionValue(object, option.name);
        ASSERT_TRUE(setOption(object, option.name, value)) << option.name << '=' << value;
        EXPECT_EQ(optionValue(object, option.name), value);
    }
}

TYPED_TEST(OptionsOf, HoldTheirLimits) {
    for (Option const& option : optionsOf<TypeParam>()) {
        if (option.kind != OptionKind::Number && option.kind != OptionKind::Integer) continue;
        for (const double limit : { option.least, option.most }) {
            TypeParam object;
            EXPECT_TRUE(setOption(object, option.name, repeated(option, limit))) << option.name << '=' << limit;
        }
        for (const double outside : { beyond(option, option.least, -1), beyond(option, option.most, 1) }) {
            TypeParam object;
            const std::string before = *optionValue(object, option.name);
            const Result<void> done = setOption(object, option.name, repeated(option, outside));
            ASSERT_FALSE(done) << option.name << '=' << outside;
            EXPECT_EQ(done.error().code, ErrorCode::InvalidArgument);
            EXPECT_NE(done.error().message.find(rangeOf(option)), std::string::npos) << done.error().message;
            EXPECT_EQ(*optionValue(object, option.name), before) << "unchanged";
        }
    }
}

TYPED_TEST(OptionsOf, RefuseTextsThatAreNoValues) {
    for (Option const& option : optionsOf<TypeParam>()) {
        for (const char* text : { "", "nan", "no such value", "1,", ",1", "1,1,1,1,1", "0x1", " 1", "ON" }) {
            TypeParam object;
            EXPECT_FALSE(setOption(object, option.name, text)) << option.name << '=' << text;
        }
    }
    TypeParam object;
    EXPECT_EQ(setOption(object, "no such option", "1").error().code, ErrorCode::NotFound);
    EXPECT_FALSE(optionValue(object, "no such option"));
}

/// Fills the bytes of every number with what a program could leave there.
TYPED_TEST(OptionsOf, AreClampedToTheirRanges) {
    for (const float wild : { -std::numeric_limits<float>::infinity(), 1e30f, NAN, -0.0f }) {
        TypeParam object;
        for (Option const& option : optionsOf<TypeParam>()) {
            auto* bytes = reinterpret_cast<std::byte*>(&object) + option.offset;
            if (option.storage == Option::Storage::Float) {
                for (int i = 0; i < option.components; ++i)
                    std::memcpy(bytes + i * sizeof(float), &wild, sizeof(float));
            } else if (option.storage == Option::Storage::Uint8) {
                *bytes = std::byte{ 255 };
            }
        }
        const TypeParam tame = clamped(object);
        const TypeParam standard;
        for (Option const& option : optionsOf<TypeParam>()) {
            TypeParam again;
            const std::string value = optionValue(option, &tame);
            if (option.onlyValues) continue; // not a range
            EXPECT_TRUE(setOption(again, option.name, value)) << option.name << '=' << value;
            const bool isDefault = std::isnan(wild) && option.storage == Option::Storage::Float;
            EXPECT_EQ(value, isDefault ? optionValue(option, &standard) : value) << option.name;
        }
    }
}

TEST(Options, OneNumberStandsForAllComponents) {
    View view;
    ASSERT_TRUE(setOption(view, "resolution.scale", "0.67"));
    EXPECT_EQ(view.effects.resolution.scale, float2(0.67f));
    EXPECT_EQ(optionValue(view, "resolution.scale"), "0.67,0.67");
    ASSERT_TRUE(setOption(view, "resolution.scale", "0.5,1"));
    EXPECT_EQ(view.effects.resolution.scale, float2(0.5f, 1));
    EXPECT_EQ(setOption(view, "resolution.scale", "0.5,2").error().message,
              "option resolution.scale: '0.5,2' is not X,Y, each from 0.5 to 1, or one number for all");
}

TEST(Options, ErrorsNameTheNearestOptionAndTheRange) {
    View view;
    EXPECT_EQ(setOption(view, "bloom.strenth", "1").error().message,
              "there is no option 'bloom.strenth'; did you mean 'bloom.strength'?");
    EXPECT_EQ(setOption(view, "shBands", "4").error().message, "option shBands: '4' is not 1, 2 or 3");
    EXPECT_EQ(setOption(view, "dfgTableSize", "15").error().message,
              "option dfgTableSize: '15' is not a whole number from 16 to 256");
    EXPECT_EQ(setOption(view, "samples", "2").error().message, "option samples: '2' is not 1 or 4");
    EXPECT_EQ(setOption(view, "splitSum", "Table").error().message,
              "option splitSum: 'Table' is not table or analytic");
    EXPECT_EQ(setOption(view, "contactShadows.thicknessMeters", "1e9").error().message,
              "option contactShadows.thicknessMeters: '1e9' is not metres from 0.00001 to 10000");
}

TEST(Options, OfAViewAreThoseOfItsMembers) {
    constexpr size_t ownOptions = 4; // samples, occlusionCulling, lod.pixels and debugView
    EXPECT_EQ(optionsOf<View>().size(), optionsOf<Quality>().size() + optionsOf<Effects>().size() +
                                                optionsOf<DisplayTransform>().size() +
                                                optionsOf<SectionPlanes>().size() + ownOptions);
    View view;
    ASSERT_TRUE(setOption(view, "toneCurve.contrast", "2"));
    EXPECT_EQ(view.display.toneCurve.contrast, 2);
    ASSERT_TRUE(setOption(view, "shadowCascades", "3"));
    EXPECT_EQ(view.quality.shadowCascades, 3);
    ASSERT_TRUE(setOption(view, "debugView", "froxels"));
    EXPECT_EQ(view.debugView, DebugView::Froxels);
    ASSERT_TRUE(setOption(view, "lensFlare.ghostCount", "7"));
    EXPECT_EQ(view.effects.lensFlare.ghostCount, 7);
}

} // namespace
} // namespace filament_core
