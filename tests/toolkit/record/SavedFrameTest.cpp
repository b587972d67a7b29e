// SPDX-License-Identifier: Apache-2.0
// A folder draws its frame again with the recorded bits, and says what is wrong with it if it cannot.
#include "tests/toolkit/record/SmallScene.h"

#include "base/Hash.h"
#include "toolkit/mutations/Mutations.h"

#include <gmock/gmock.h>

#include <set>

namespace filament_core::record {
namespace {

using test::FrameFolder;
using test::spheresRequest;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr Backend kApis[] = { Backend::Vulkan, Backend::Gles };

Manifest saved(SaveRequest const& request) {
    Result<Manifest> manifest = saveFrame(request);
    EXPECT_TRUE(manifest.ok()) << (manifest.ok() ? "" : manifest.error().message);
    return manifest.ok() ? std::move(*manifest) : Manifest{};
}

Trace traceOf(FrameFolder const& folder, Manifest const& manifest, Backend backend) {
    TraceRecord const* record = findTrace(manifest, backend);
    if (!record) return {};
    Result<Trace> trace = loadTrace(folder.path(), *record);
    EXPECT_TRUE(trace.ok()) << (trace.ok() ? "" : trace.error().message);
    return trace.ok() ? std::move(*trace) : Trace{};
}

ReplayRequest with(Backend backend, const char* mutation) {
    return { .backend = backend, .edit = [mutation] { return tools::findMutation(mutation)->make(); } };
}

TEST(SavedFrame, ReplaysOnBothApisWithTheHashOfWhatWasShown) {
    const FrameFolder folder;
    const Manifest manifest = saved(spheresRequest(folder));
    ASSERT_THAT(manifest.traces, SizeIs(2));
    EXPECT_THAT(problemsOf(manifest), IsEmpty());
    const Result<Manifest> read = readManifest(folder.path());
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(toJson(*read), toJson(manifest));
    const auto picture = loadImage(folder.path() / "picture.png", { .content = ImageContent::Data });
    ASSERT_TRUE(picture.ok());
    EXPECT_EQ(hashBytes(picture->pixels), manifest.pictures[0].hash);
    for (const Backend api : kApis) {
        const Result<Verdict> verdict = compareReplay(*read, traceOf(folder, *read, api));
        ASSERT_TRUE(verdict.ok()) << verdict.error().message;
        EXPECT_EQ(verdict->difference, "") << toString(api);
        EXPECT_THAT(verdict->errors, IsEmpty()) << toString(api);
        EXPECT_EQ(verdict->pictures[0].image.pixels, picture->pixels) << toString(api);
        EXPECT_EQ(firstChangedPass(*read, traceOf(folder, *read, api)).value(), "") << toString(api);
    }
}

TEST(SavedFrame, TheAttachmentsOfAllPassesHaveTheSameHashesOnBothApis) {
    const FrameFolder folder;
    const Manifest manifest = saved(spheresRequest(folder));
    ASSERT_THAT(manifest.traces, SizeIs(2));
    auto const &a = manifest.traces[0].frames, &b = manifest.traces[1].frames;
    ASSERT_THAT(a, SizeIs(1));
    ASSERT_THAT(b, SizeIs(1));
    ASSERT_EQ(a[0].passes.size(), b[0].passes.size());
    for (size_t i = 0; i < a[0].passes.size(); ++i) {
        PassRecord const &x = a[0].passes[i], &y = b[0].passes[i];
        EXPECT_EQ(x.name, y.name);
        EXPECT_EQ(x.draws, y.draws);
        ASSERT_EQ(x.attachments.size(), y.attachments.size());
        for (size_t k = 0; k < x.attachments.size(); ++k)
            EXPECT_EQ(x.attachments[k].hash, y.attachments[k].hash) << x.name << " " << x.attachments[k].name;
    }
}

// As a viewer draws: several calls of render(), several images, the second one twice.
TEST(SavedFrame, HoldsEveryPictureAndEveryFrameThatLedToThem) {
    const FrameFolder folder;
    SaveRequest request = spheresRequest(folder);
    request.recipe = [](Engine& engine) -> Result<std::vector<FramePicture>> {
        std::vector<FramePicture> pictures;
        for (const char* name : { "left", "right", "right-again" }) {
            const bool isLeft = name == std::string_view("left");
            Result<Image> image =
                    test::drawSpheres(engine, isLeft ? 0.8f : 0.2f, isLeft ? Format::RGBA16F : Format::RGBA8);
            if (!image) return image.error();
            pictures.push_back({ .name = name, .image = std::move(*image) });
        }
        return pictures;
    };
    const Manifest manifest = saved(request);
    EXPECT_THAT(problemsOf(manifest), IsEmpty());
    ASSERT_THAT(manifest.pictures, SizeIs(3));
    EXPECT_EQ(manifest.pictures[1].hash, manifest.pictures[2].hash);
    EXPECT_NE(manifest.pictures[0].hash, manifest.pictures[1].hash);
    for (const char* file : { "left.exr", "right.png", "right-again.png" })
        EXPECT_TRUE(std::filesystem::exists(folder.path() / file)) << file;
    for (TraceRecord const& record : manifest.traces) {
        EXPECT_THAT(record.frames, SizeIs(3));
        EXPECT_EQ(
                std::set<uint64_t>({ record.pictures[0].ticket, record.pictures[1].ticket, record.pictures[2].ticket })
                        .size(),
                3u);
        const auto verdict = compareReplay(manifest, traceOf(folder, manifest, record.backend));
        ASSERT_TRUE(verdict.ok()) << verdict.error().message;
        EXPECT_EQ(verdict->difference, "");
    }
    const Trace vulkan = traceOf(folder, manifest, Backend::Vulkan), gles = traceOf(folder, manifest, Backend::Gles);
    const auto broken =
            firstDisagreement(vulkan, with(Backend::Vulkan, "depthCompare"), gles, { .backend = Backend::Gles });
    ASSERT_TRUE(broken.ok()) << broken.error().message;
    EXPECT_THAT(*broken, ::testing::StartsWith("frame 1, ")); // the first of the three
}

TEST(SavedFrame, SceneLinearPicturesKeepTheirBits) {
    const FrameFolder folder;
    SaveRequest request = spheresRequest(folder);
    request.recipe = test::spheresRecipe(0.8f, Format::RGBA16F);
    const Manifest manifest = saved(request);
    EXPECT_THAT(problemsOf(manifest), IsEmpty());
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "picture.exr"));
    const auto verdict = compareReplay(manifest, traceOf(folder, manifest, Backend::Vulkan));
    ASSERT_TRUE(verdict.ok()) << verdict.error().message;
    EXPECT_EQ(verdict->difference, "");
}

TEST(SavedFrame, WhatDoesNotDrawWhatWasShownSaysSo) {
    const FrameFolder folder;
    SaveRequest request = spheresRequest(folder);
    int calls = 0;
    request.recipe = [&calls](Engine& engine) { return test::spheresRecipe(calls++ == 0 ? 0.8f : 0.7f)(engine); };
    const Manifest manifest = saved(request);
    ASSERT_THAT(manifest.traces, SizeIs(2));
    EXPECT_EQ(manifest.traces[0].problem, "");
    EXPECT_THAT(manifest.traces[1].problem, HasSubstr("pixels are not as shown"));
    EXPECT_THAT(problemsOf(manifest), SizeIs(1));
    // It is in the folder as well, and the replay of that trace is not equal either.
    const Result<Manifest> read = readManifest(folder.path());
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read->traces[1].problem, manifest.traces[1].problem);
    const auto verdict = compareReplay(*read, traceOf(folder, *read, Backend::Gles));
    ASSERT_TRUE(verdict.ok());
    EXPECT_THAT(verdict->difference, HasSubstr("instead of"));
    EXPECT_EQ(firstChangedPass(*read, traceOf(folder, *read, Backend::Gles)).value(),
              ""); // the trace is what was saved
}

TEST(SavedFrame, WhatWasOnTheScreenIsWhatCounts) {
    const FrameFolder folder;
    SaveRequest request = spheresRequest(folder);
    Result<Engine> engine = Engine::create({ .backend = Backend::Vulkan, .workers = 0 });
    ASSERT_TRUE(engine.ok());
    request.shown = test::spheresRecipe(0.5f)(*engine).value();
    for (TraceRecord const& trace : saved(request).traces) EXPECT_THAT(trace.problem, HasSubstr("not as shown"));
    request.recipe = test::spheresRecipe(0.5f);
    EXPECT_THAT(problemsOf(saved(request)), IsEmpty()); // into the same folder
}

TEST(SavedFrame, AnApiWithoutADeviceIsNoted) {
    const FrameFolder folder;
    SaveRequest request = spheresRequest(folder);
    request.engine.requireDevice = "no such device";
    const Result<Manifest> none = saveFrame(request);
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().code, ErrorCode::DeviceUnavailable);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "frame.json"));
    request.engine.requireDevice.clear();
    request.backends = { Backend::Gles };
    const Manifest one = saved(request);
    ASSERT_THAT(one.traces, SizeIs(1));
    EXPECT_EQ(one.traces[0].backend, Backend::Gles);
    const auto missing = compareReplay(one, Trace{ .backend = Backend::Vulkan });
    ASSERT_FALSE(missing.ok());
    EXPECT_THAT(missing.error().message, HasSubstr("no trace of vulkan"));
}

TEST(SavedFrame, RequestsThatCannotBeSavedAreRefused) {
    const FrameFolder folder;
    const auto refusal = [&](std::function<void(SaveRequest&)> const& change) {
        SaveRequest request = spheresRequest(folder);
        change(request);
        const Result<Manifest> result = saveFrame(request);
        return result.ok() ? std::string("saved") : result.error().message;
    };
    const Image small{ .width = 1, .height = 1, .pixels = std::vector<std::byte>(4) };
    EXPECT_THAT(refusal([](SaveRequest& r) { r.recipe = nullptr; }), HasSubstr("recipe"));
    EXPECT_THAT(refusal([](SaveRequest& r) { r.settings = "{"; }), HasSubstr("JSON"));
    EXPECT_THAT(refusal([](SaveRequest& r) { r.backends = { Backend::Null }; }), HasSubstr("not on null"));
    EXPECT_THAT(refusal([](SaveRequest& r) { r.backends = { Backend::Gles, Backend::Gles }; }), HasSubstr("twice"));
    EXPECT_THAT(refusal([&](SaveRequest& r) {
                    r.shown = { { "a", small }, { "a", small } };
                }),
                HasSubstr("'a' cannot"));
    EXPECT_THAT(refusal([&](SaveRequest& r) { r.shown = { { "../a", small } }; }), HasSubstr("cannot name"));
    EXPECT_THAT(refusal([](SaveRequest& r) {
                    r.shown = { { "a", Image{ .width = 2, .height = 1 } } };
                }),
                HasSubstr("has 0 bytes"));
    EXPECT_THAT(refusal([](SaveRequest& r) { r.folder = "/dev/null/x"; }), HasSubstr("/dev/null/x"));
    EXPECT_THAT(refusal([](SaveRequest& r) {
                    r.recipe = [](Engine&) -> Result<std::vector<FramePicture>> {
                        return fail(ErrorCode::NotFound, "no model");
                    };
                }),
                HasSubstr("vulkan: no model"));
}

TEST(SavedFrame, DamagedFilesAreNamed) {
    const FrameFolder folder;
    SaveRequest request = spheresRequest(folder);
    request.backends = { Backend::Vulkan };
    const Manifest manifest = saved(request);
    ASSERT_THAT(manifest.traces, SizeIs(1));
    const auto problemAfter = [&](std::filesystem::path const& path, auto const& damage) {
        const std::string before = test::bytesOf(path);
        std::string bytes = before;
        damage(bytes);
        test::writeBytes(path, bytes);
        const Result<Trace> trace = loadTrace(folder.path(), manifest.traces[0]);
        test::writeBytes(path, before);
        return trace.ok() ? std::string("accepted") : trace.error().message;
    };
    const auto flip = [](std::string& bytes) { bytes[bytes.size() / 2] ^= 1; };
    const auto cut = [](std::string& bytes) { bytes.resize(bytes.size() / 2); };
    for (const char* name : { "vulkan.trace", "vulkan.trace.bin" }) {
        const std::filesystem::path path = folder.path() / name;
        EXPECT_THAT(problemAfter(path, flip), HasSubstr(path.string() + ": its bytes are not those that were saved"));
        EXPECT_THAT(problemAfter(path, cut), HasSubstr(path.string() + ": it has "));
    }
    EXPECT_TRUE(loadTrace(folder.path(), manifest.traces[0]).ok());
    std::filesystem::remove(folder.path() / "vulkan.trace.bin");
    EXPECT_THAT(loadTrace(folder.path(), manifest.traces[0]).error().message,
                HasSubstr("vulkan.trace.bin' is missing"));
    // A pipe would never end.
    std::filesystem::create_symlink("/dev/zero", folder.path() / "vulkan.trace.bin");
    EXPECT_THAT(loadTrace(folder.path(), manifest.traces[0]).error().message, HasSubstr("is missing"));
}

TEST(SavedFrame, ATruncatedTraceWhoseHashWasAdjustedNamesItsLine) {
    const FrameFolder folder;
    SaveRequest request = spheresRequest(folder);
    request.backends = { Backend::Gles };
    Manifest manifest = saved(request);
    ASSERT_THAT(manifest.traces, SizeIs(1));
    const std::filesystem::path path = folder.path() / "gles.trace";
    std::string text = test::bytesOf(path);
    text.resize(text.find("CreateTexture", text.size() / 2) + 15);
    test::writeBytes(path, text);
    manifest.traces[0].textBytes = text.size();
    manifest.traces[0].textHash = hashString(text);
    const Result<Trace> trace = loadTrace(folder.path(), manifest.traces[0]);
    ASSERT_FALSE(trace.ok());
    EXPECT_EQ(trace.error().code, ErrorCode::Corrupt);
    EXPECT_THAT(trace.error().message, HasSubstr("gles.trace: line "));
}

TEST(SavedFrame, ADefectIsFoundInThePassAndAtTheDrawWhereItActs) {
    const FrameFolder folder;
    const Manifest manifest = saved(spheresRequest(folder));
    ASSERT_THAT(manifest.traces, SizeIs(2));
    const Trace vulkan = traceOf(folder, manifest, Backend::Vulkan), gles = traceOf(folder, manifest, Backend::Gles);
    for (Trace const* trace : { &vulkan, &gles }) {
        const ReplayRequest broken = with(trace->backend, "depthCompare");
        const auto verdict = compareReplay(manifest, *trace, broken);
        ASSERT_TRUE(verdict.ok()) << verdict.error().message;
        EXPECT_THAT(verdict->difference, HasSubstr("picture 'picture' has the hash"));
        const auto pass = firstChangedPass(manifest, *trace, broken);
        ASSERT_TRUE(pass.ok()) << pass.error().message;
        EXPECT_THAT(*pass, HasSubstr("frame 1, pass ")) << toString(trace->backend);
    }
    const auto found =
            firstDisagreement(vulkan, { .backend = Backend::Vulkan }, gles, with(Backend::Gles, "depthCompare"));
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_THAT(*found, HasSubstr("pipeline 'gltf_lit_opaque'"));
    const auto equal = firstDisagreement(vulkan, { .backend = Backend::Vulkan }, gles, { .backend = Backend::Gles });
    ASSERT_TRUE(equal.ok());
    EXPECT_EQ(*equal, "");
}

TEST(Replay, OfAnotherApiIsRefused) {
    const FrameFolder folder;
    SaveRequest request = spheresRequest(folder);
    request.backends = { Backend::Vulkan };
    const Trace trace = traceOf(folder, saved(request), Backend::Vulkan);
    const auto other = replayTrace(trace, { .backend = Backend::Gles });
    ASSERT_FALSE(other.ok());
    EXPECT_EQ(other.error().code, ErrorCode::Unsupported);
    const auto frame = replayTrace(trace, { .backend = Backend::Vulkan, .inside = { { .frame = 7 } } });
    ASSERT_FALSE(frame.ok());
    EXPECT_THAT(frame.error().message, HasSubstr("there is no frame 8; the trace has 1"));
    const auto none = replayTrace(trace, { .backend = Backend::Null });
    ASSERT_TRUE(none.ok()) << none.error().message;
    EXPECT_THAT(none->errors, IsEmpty());
    EXPECT_THAT(none->answers, ::testing::Not(IsEmpty()));
}

TEST(Trace, ListsThePassesAndDrawsThatACaptureSees) {
    const FrameFolder folder;
    SaveRequest request = spheresRequest(folder);
    request.backends = { Backend::Gles };
    const Trace trace = traceOf(folder, saved(request), Backend::Gles);
    ASSERT_THAT(trace.frames, SizeIs(1));
    const auto captured = frameOf(trace, { .backend = Backend::Gles }, 0)(backend::kAllDraws);
    ASSERT_TRUE(captured.ok()) << captured.error().message;
    ListedFrame const& listed = trace.frames[0];
    ASSERT_EQ(listed.passes.size(), captured->passes.size());
    ASSERT_EQ(listed.draws.size(), captured->draws.size());
    for (size_t i = 0; i < listed.passes.size(); ++i) {
        EXPECT_EQ(listed.passes[i].name, captured->passes[i].name);
        EXPECT_EQ(listed.passes[i].firstDraw, captured->passes[i].firstDraw);
        EXPECT_EQ(listed.passes[i].drawCount, captured->passes[i].drawCount);
    }
    for (size_t i = 0; i < listed.draws.size(); ++i) {
        EXPECT_EQ(listed.draws[i].position, captured->draws[i].position);
        EXPECT_EQ(listed.draws[i].pipeline, captured->draws[i].pipeline);
    }
}

} // namespace
} // namespace filament_core::record
