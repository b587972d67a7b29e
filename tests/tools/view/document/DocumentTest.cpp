// SPDX-License-Identifier: Apache-2.0
#include "tools/view/document/Document.h"
#include "tests/tools/view/document/Leaves.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>

namespace filament_core::view {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

Document read(std::string const& text) {
    Result<Document> document = documentFromJson(text, "test.json");
    EXPECT_TRUE(document.ok()) << document.error().message;
    return document ? std::move(*document) : Document{};
}

size_t leafCount() {
    Document document = fullDocument();
    size_t count = 0;
    forEachLeaf(document, [&](std::string const&, Change const&) { ++count; });
    return count;
}

/// Changes the leaf of this number and returns its place.
std::string changeLeaf(Document& document, size_t number, Random& random) {
    size_t count = 0;
    std::string changed;
    Change chosen;
    forEachLeaf(document, [&](std::string const& place, Change const& change) {
        if (count++ != number) return;
        changed = place;
        chosen = change;
    });
    chosen(random);
    return changed;
}

TEST(Document, KeepsEveryFieldThatIsChangedAlone) {
    const Document base = fullDocument();
    const std::string text = toJson(base);
    ASSERT_TRUE(check(base).ok()) << check(base).error().message;
    EXPECT_EQ(read(text), base);
    Random random(1);
    size_t kept = 0;
    for (size_t i = 0, count = leafCount(); i < count; ++i) {
        Document changed = base;
        std::string place;
        for (int tries = 0; tries < 40; ++tries) { // some values break a rule with another field
            changed = base;
            place = changeLeaf(changed, i, random);
            if (check(changed).ok()) break;
        }
        ASSERT_TRUE(check(changed).ok()) << check(changed).error().message;
        EXPECT_FALSE(changed == base) << place << " is not compared, or nothing changes it";
        EXPECT_NE(toJson(changed), text) << place << " is not written";
        EXPECT_EQ(read(toJson(changed)), changed) << place;
        kept += changed != base;
    }
    EXPECT_GT(kept, 500u);
}

TEST(Document, KeepsEverythingThatIsChangedTogether) {
    Random random(2);
    for (int round = 0; round < 25; ++round) {
        Document document = fullDocument();
        for (size_t changes = random() % 80; changes > 0; --changes) {
            Document changed = document;
            size_t count = 0;
            forEachLeaf(changed, [&](std::string const&, Change const&) { ++count; });
            changeLeaf(changed, random() % count, random);
            if (check(changed).ok()) document = changed;
        }
        const Document again = read(toJson(document));
        EXPECT_EQ(again, document);
        EXPECT_EQ(toJson(again), toJson(document));
    }
}

TEST(Document, NamesEveryOptionOfTheView) {
    EXPECT_EQ(memberCount<Quality>(), optionsOf<Quality>().size());
    const size_t members = memberCount<AmbientOcclusion>() + memberCount<ScreenSpaceReflections>() +
                           memberCount<Fog>() + memberCount<ContactShadows>() + memberCount<Bloom>() +
                           memberCount<DepthOfField>() + memberCount<MotionBlur>() + memberCount<AutoExposure>() +
                           memberCount<ColorGrading>() + memberCount<Vignette>() + memberCount<Grain>() +
                           memberCount<ChromaticAberration>() + memberCount<Resolution>() + memberCount<Sharpening>() +
                           memberCount<LensFlare>() + memberCount<GuardBand>();
    EXPECT_EQ(memberCount<Effects>(), 16u) << "add the new effect above";
    const size_t dirt = 1; // Document::dirt
    EXPECT_EQ(members - dirt, optionsOf<Effects>().size());
    const size_t ofCurve = memberCount<ToneCurve>() - 1, look = 1; // Document::look
    EXPECT_EQ(memberCount<DisplayTransform>() + ofCurve - look, optionsOf<DisplayTransform>().size());
}

/// All values of a tree that are no object.
void forEachValue(Json& json, std::string const& place, std::function<void(Json&, std::string const&)> const& visit) {
    if (json.is_object()) {
        for (auto it = json.begin(); it != json.end(); ++it)
            forEachValue(*it, place.empty() ? it.key() : place + "." + it.key(), visit);
        return;
    }
    visit(json, place);
    if (!json.is_array()) return;
    for (size_t i = 0; i < json.size(); ++i) {
        if (json[i].is_object()) forEachValue(json[i], fmt::format("{}[{}]", place, i), visit);
    }
}

TEST(Document, RefusesEveryValueOfAnotherKindAndNamesItsPlace) {
    Json tree = Json::parse(toJson(fullDocument()));
    size_t refused = 0;
    forEachValue(tree, "", [&](Json& value, std::string const& place) {
        const Json kept = value;
        value = Json{ { "neither", "of these" } };
        const Result<Document> document = documentFromJson(tree.dump(), "test.json");
        value = kept;
        ASSERT_FALSE(document.ok()) << place;
        EXPECT_THAT(document.error().message, HasSubstr("test.json: " + place));
        EXPECT_THAT(document.error().message, Not(HasSubstr("\n")));
        ++refused;
    });
    EXPECT_GT(refused, 300u);
}

TEST(Document, RefusesUnknownFieldsAndNamesTheNearest) {
    Json tree = Json::parse(toJson(fullDocument()));
    tree["view"]["camera"]["lens"]["nearMetres"] = 1;
    EXPECT_EQ(documentFromJson(tree.dump(), "a.json").error().message,
              "a.json: view.camera.lens: there is no field 'nearMetres'; did you mean 'nearMeters'?");
    tree["view"]["camera"]["lens"].erase("nearMetres");
    tree["view"]["quality"]["shadow"] = "off";
    EXPECT_THAT(documentFromJson(tree.dump(), "a.json").error().message, HasSubstr("a.json: view.quality.shadow: "));
}

TEST(Document, SaysWhichByteIsNoJson) {
    EXPECT_EQ(documentFromJson("{\"version\": 1,, }", "a.json").error().message,
              "a.json: this is no JSON text: byte 15 of 17 is wrong");
    EXPECT_THAT(documentFromJson("{\"version\": 1, \"look\": 1e999}", "a.json").error().message,
                HasSubstr("a.json: this is no JSON text"));
    EXPECT_EQ(documentFromJson("[]", "a.json").error().message, "a.json: expected an object");
    EXPECT_THAT(documentFromJson("{}", "a.json").error().message, HasSubstr("a.json: version: expected 1"));
    EXPECT_EQ(documentFromJson("{\"version\": 2}", "a.json").error().code, ErrorCode::Unsupported);
    EXPECT_EQ(read("{\"version\": 1}"), Document{});
}

/// Gives every number of a document, one after the other, a value that is none of its range.
class BreakNumbers {
public:
    explicit BreakNumbers(Document& document) : mDocument(document) {}
    template <class T>
    void walk(std::string const& place, T& value, double low, double high) {
        if constexpr (IsOptions<T> || IsNamed<T> || std::is_same_v<T, bool>) {
            return;
        } else if constexpr (HasFields<T>) {
            forEachField<T>([&](auto const& field) {
                walk(place.empty() ? field.name : place + "." + field.name, value.*field.member, field.low, field.high);
            });
        } else if constexpr (IsNumber<T>) {
            number(place, value, low, high);
        } else if constexpr (IsUnit<T>) {
            number(place, value.value, low, high);
        } else if constexpr (IsVector<T>) {
            for (int i = 0; i < VectorOf<T>::size; ++i) {
                if constexpr (!std::is_same_v<typename T::value_type, bool>) number(place, value[i], low, high);
            }
        } else if constexpr (IsMatrix<T>) {
            for (int i = 0; i < MatrixOf<T>::size; ++i) walk(place, value[i], low, high);
        } else if constexpr (IsOptional<T>) {
            if (value) walk(place, *value, low, high);
        } else if constexpr (IsList<T>) {
            for (size_t i = 0; i < value.size(); ++i) walk(fmt::format("{}[{}]", place, i), value[i], low, high);
        } else if constexpr (std::is_same_v<T, LightDesc> || std::is_same_v<T, ParameterValue>) {
            std::visit([&](auto& held) { walk(place, held, low, high); }, value);
        }
    }
    size_t refused() const { return mRefused; }

private:
    template <class T>
    void number(std::string const& place, T& value, double low, double high) {
        const T kept = value;
        if constexpr (std::is_floating_point_v<T>) {
            for (const T bad : { std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity() })
                expectRefused(place, value, bad);
            if (low > -1e299) expectRefused(place, value, static_cast<T>(low - 1 - std::abs(low) * 0.01));
        }
        if (high < 1e299 && high < static_cast<double>(std::numeric_limits<T>::max()) * 0.9)
            expectRefused(place, value, static_cast<T>(high + 1 + std::abs(high) * 0.01));
        value = kept;
    }
    template <class T>
    void expectRefused(std::string const& place, T& value, T bad) {
        value = bad;
        const Result<void> valid = check(mDocument);
        ASSERT_FALSE(valid.ok()) << place << " = " << static_cast<double>(bad);
        EXPECT_THAT(valid.error().message, HasSubstr(place));
        ++mRefused;
    }

    Document& mDocument;
    size_t mRefused = 0;
};

TEST(Document, RefusesEveryNumberOutOfItsRangeAndNamesItsPlace) {
    Document document = fullDocument();
    BreakNumbers numbers(document);
    numbers.walk("", document, -kAnyNumber, kAnyNumber);
    EXPECT_GT(numbers.refused(), 400u);
    EXPECT_TRUE(check(document).ok());
}

TEST(Document, RefusesWhatBreaksARuleOfSeveralFields) {
    const auto expectRefused = [](std::string const& place, auto const& spoil) {
        Document document = fullDocument();
        spoil(document);
        const Result<void> valid = check(document);
        ASSERT_FALSE(valid.ok()) << place;
        EXPECT_THAT(valid.error().message, testing::StartsWith(place));
    };
    expectRefused("view.samples", [](Document& d) { d.view.samples = 2; });
    expectRefused("view.camera.worldFromView", [](Document& d) { d.view.camera.worldFromView[0] *= 2.0; });
    expectRefused("view.camera.worldFromView", [](Document& d) { d.view.camera.worldFromView[0] *= -1.0; });
    expectRefused("view.camera.worldFromView", [](Document& d) { d.view.camera.worldFromView[1].w = 1; });
    expectRefused("view.camera.lens.nearMeters", [](Document& d) { d.view.camera.lens.nearMeters = 0; });
    expectRefused("view.camera.lens.farMeters", [](Document& d) {
        d.view.camera.lens = { .nearMeters = 5, .orthographicHeight = 1, .farMeters = 5 };
    });
    expectRefused("view.effects", [](Document& d) { d.view.effects.fog.density = -1; });
    expectRefused("view.effects", [](Document& d) { d.view.effects.bloom.strength = std::nanf(""); });
    expectRefused("view.display", [](Document& d) { d.view.display.whiteNits = 1; });
    expectRefused("view.quality", [](Document& d) { d.view.quality.shBands = 9; });
    expectRefused("environment.options.faceSize", [](Document& d) { d.environment.options.faceSize = 100; });
    expectRefused("nodes[1]", [](Document& d) { d.nodes[1].node = d.nodes[0].node; });
    expectRefused("modelLights[1]", [](Document& d) { d.modelLights[1].light = d.modelLights[0].light; });
    expectRefused("morphs[1]", [](Document& d) { d.morphs.push_back(d.morphs[0]); });
    expectRefused("materials[1]", [](Document& d) { d.materials[1].parameter = d.materials[0].parameter; });
    expectRefused("paths[0].keys[2].seconds", [](Document& d) { d.paths[0].keys[2].seconds = 1; });
    expectRefused("lights[0].light.directionWorld",
                  [](Document& d) { d.lights[0].light = SunLight{ .directionWorld = float3(0) }; });
    expectRefused("lights[5].light.axisWorld",
                  [](Document& d) { d.lights[5].light = TubeLight{ .axisWorld = float3(0) }; });
    expectRefused("lights[2].light.innerConeRadians", [](Document& d) {
        d.lights[2].light = SpotLight{ .innerConeRadians = 0.5f, .outerConeRadians = 0.5f };
    });
}

TEST(Document, IsWrittenToAFileAndReadAgain) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "document-test.json";
    ASSERT_TRUE(saveDocument(file, fullDocument()).ok());
    const Result<Document> again = loadDocument(file);
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(*again, fullDocument());
    std::filesystem::remove(file);
    EXPECT_THAT(loadDocument(file).error().message, HasSubstr("document-test.json"));
    EXPECT_THAT(saveDocument("/dev/null/at all", {}).error().message, HasSubstr("/dev/null/at all"));
}

/// For as long as it lives, no file grows beyond so many bytes: a full disk.
class FullDisk {
public:
    explicit FullDisk(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &mBefore);
        mHandler = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{ bytes, mBefore.rlim_max };
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    FullDisk(FullDisk const&) = delete;
    FullDisk& operator=(FullDisk const&) = delete;
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &mBefore);
        std::signal(SIGXFSZ, mHandler);
    }

private:
    rlimit mBefore{};
    void (*mHandler)(int) = nullptr;
};

TEST(Document, AFullDiskLeavesTheFileThatWasThere) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "document-kept.json";
    ASSERT_TRUE(saveDocument(file, fullDocument()).ok());
    Result<void> saved;
    {
        const FullDisk disk(64);
        saved = saveDocument(file, {});
    }
    ASSERT_FALSE(saved.ok());
    EXPECT_THAT(saved.error().message, HasSubstr("document-kept.json"));
    const Result<Document> kept = loadDocument(file);
    ASSERT_TRUE(kept.ok()) << kept.error().message;
    EXPECT_EQ(*kept, fullDocument());
    std::filesystem::remove(file);
}

TEST(Document, IsMadeOfACommandLine) {
    tools::SceneOptions options;
    tools::SceneWords words;
    words.eye = { "1", "2", "3" };
    words.size = "320x200";
    words.sun = { "5000", "1", "-2", "0.5" };
    words.iblIntensity = "1234";
    words.set = { "shadows=pcss", "fog.density=0.25", "samples=4", "debugView=froxels", "model.positions=half" };
    ASSERT_TRUE(tools::convertSceneOptions(words, options).ok());
    options.variant = "midnight";
    const Document document = makeDocument(options, "a.glb", "b.hdr");
    EXPECT_TRUE(check(document).ok());
    EXPECT_EQ(document.model.file, "a.glb");
    EXPECT_EQ(document.model.variant, "midnight");
    EXPECT_EQ(document.model.options.positions, PositionStorage::Half);
    EXPECT_EQ(document.environment.file, "b.hdr");
    EXPECT_EQ(document.environment.settings.illuminance.value, 1234);
    EXPECT_TRUE(document.environment.prefersModels);
    EXPECT_EQ(document.view.size, uint2(320, 200));
    EXPECT_EQ(document.view.camera.position(), double3(1, 2, 3));
    EXPECT_EQ(document.view.quality.shadows, ShadowFilter::Pcss);
    EXPECT_EQ(document.view.effects.fog.density, 0.25f);
    EXPECT_EQ(document.view.samples, 4);
    EXPECT_EQ(document.view.debugView, DebugView::Froxels);
    ASSERT_EQ(document.lights.size(), 1u);
    EXPECT_EQ(std::get<SunLight>(document.lights[0].light).illuminance.value, 5000);
    options.environment = "c.hdr";
    EXPECT_FALSE(makeDocument(options, "a.glb", "c.hdr").environment.prefersModels);
}

TEST(DocumentEdits, AreFoundOrAddedAndRemovedWhenIdle) {
    Document document;
    nodeEdit(document, 4).isVisible = false;
    nodeEdit(document, 7);
    nodeEdit(document, 4).parentFromNode = double4x4(3.0);
    modelLightEdit(document, 1);
    modelLightEdit(document, 2).isOn = false;
    setParameter(document, "paint", "roughness", 0.5f);
    setParameter(document, "paint", "roughness", 0.75f);
    setParameter(document, "glass", "roughness", 0.1f);
    setMorph(document, "smile", 1);
    setMorph(document, "smile", 0.25f);
    EXPECT_EQ(document.nodes.size(), 2u);
    EXPECT_EQ(document.materials.size(), 2u);
    EXPECT_EQ(document.materials[0].value, ParameterValue(0.75f));
    EXPECT_EQ(document.morphs, (std::vector<MorphEdit>{ { "smile", 0.25f } }));
    EXPECT_TRUE(check(document).ok());
    removeIdleEdits(document);
    ASSERT_EQ(document.nodes.size(), 1u);
    EXPECT_EQ(document.nodes[0].node, 4u);
    ASSERT_EQ(document.modelLights.size(), 1u);
    EXPECT_EQ(document.modelLights[0].light, 2u);
    resetParameter(document, "paint", "roughness");
    ASSERT_EQ(document.materials.size(), 1u);
    EXPECT_EQ(document.materials[0].material, "glass");
}

TEST(Playback, DoesNotDependOnTheStepsOfTime) {
    Random random(3);
    for (int round = 0; round < 200; ++round) {
        const double duration = between(random, 0.1, 10), elapsed = between(random, 0, 30);
        const int steps = 1 + static_cast<int>(random() % 50);
        const Playback start{ .animation = 0,
                              .seconds = between(random, 0, duration),
                              .isPlaying = true,
                              .speed = between(random, -3, 3),
                              .loops = round % 2 == 0 };
        Playback stepped = start;
        for (int i = 0; i < steps; ++i) stepped = advanced(stepped, elapsed / steps, duration);
        const Playback once = advanced(start, elapsed, duration);
        const double apart = std::abs(stepped.seconds - once.seconds);
        EXPECT_LT(std::min(apart, start.loops ? duration - apart : apart), 1e-9);
        EXPECT_GE(once.seconds, 0);
        EXPECT_LE(once.seconds, duration);
    }
}

TEST(Playback, StopsAtItsEndsUnlessItLoops) {
    const Playback playing{ .animation = 0, .seconds = 1, .isPlaying = true, .loops = false };
    EXPECT_EQ(advanced(playing, 0.5, 2),
              (Playback{ .animation = 0, .seconds = 1.5, .isPlaying = true, .loops = false }));
    EXPECT_EQ(advanced(playing, 5, 2), (Playback{ .animation = 0, .seconds = 2, .isPlaying = false, .loops = false }));
    Playback backwards = playing;
    backwards.speed = -1;
    EXPECT_EQ(advanced(backwards, 5, 2).seconds, 0);
    EXPECT_FALSE(advanced(backwards, 5, 2).isPlaying);
    Playback paused = playing;
    paused.isPlaying = false;
    EXPECT_EQ(advanced(paused, 5, 2), paused);
    EXPECT_EQ(advanced(Playback{ .isPlaying = true }, 5, 2), Playback{ .isPlaying = true });
    EXPECT_EQ(advanced(playing, 1, 0).seconds, 0);
}

} // namespace
} // namespace filament_core::view
