// SPDX-License-Identifier: Apache-2.0
// An image in parts: whichever way it is divided, the parts merge to the bits of one run, and what is no complete
// image is refused with its file.
#include "tools/reference/Merge.h"
#include "tests/fuzz/FilmFileFuzzBody.h"
#include "tests/tools/reference/TestScenes.h"
#include "tools/reference/Division.h"

#include <gmock/gmock.h>

#include <fstream>
#include <functional>
#include <random>
#include <set>
#include <unistd.h>

namespace filament_core::reference {
namespace {

using ::testing::HasSubstr;

/// `region` in parts, each cut in two along random axes until the dice stop it.
std::vector<FilmRegion> randomParts(FilmRegion const& region, std::mt19937& random, uint32_t depth = 0) {
    uint32_t const lengths[] = { region.size.x, region.size.y, region.passes.count };
    const auto axis = static_cast<int>(random() % 3);
    if (depth >= 2 && random() % 3 == 0) return { region };
    if (depth > 5 || lengths[axis] < 2) return { region };
    const auto cut = static_cast<uint32_t>(1 + random() % (lengths[axis] - 1));
    FilmRegion first = region, second = region;
    if (axis < 2) {
        first.size[axis] = cut, second.size[axis] -= cut, second.offset[axis] += cut;
    } else {
        first.passes.count = cut, second.passes = { region.passes.first + cut, region.passes.count - cut };
    }
    std::vector<FilmRegion> parts = randomParts(first, random, depth + 1);
    for (FilmRegion const& part : randomParts(second, random, depth + 1)) parts.push_back(part);
    return parts;
}

TEST(FilmNodes, AreTheFewestThatFillARange) {
    using Ranges = std::vector<PassRange>;
    EXPECT_EQ(nodesOf({ 0, 16 }), (Ranges{ { 0, 16 } }));
    EXPECT_EQ(nodesOf({ 0, 13 }), (Ranges{ { 0, 8 }, { 8, 4 }, { 12, 1 } }));
    EXPECT_EQ(nodesOf({ 3, 6 }), (Ranges{ { 3, 1 }, { 4, 4 }, { 8, 1 } }));
    EXPECT_TRUE(nodesOf({ 5, 0 }).empty());
    for (uint32_t first = 0; first < 20; ++first) {
        for (uint32_t count = 1; count < 20; ++count) {
            uint32_t next = first;
            for (PassRange const& node : nodesOf({ first, count })) {
                EXPECT_EQ(node.first, next);
                EXPECT_EQ(node.first % node.count, 0u) << "aligned";
                next = node.end();
            }
            EXPECT_EQ(next, first + count);
        }
    }
}

/// Numbers whose sum depends on the order, as a function of pixel and pass.
double3 meanOf(size_t pixel, uint32_t pass) {
    const auto unit = [&](uint64_t salt) {
        return double(mixBits(pixel * 977 + pass * 131071 + salt) >> 11) * 0x1p-53;
    };
    return { unit(1), std::exp(20 * unit(2) - 10), unit(3) < 0.02 ? 1e9 : unit(4) };
}

PartialFilm exposed(FilmRegion const& region, uint2 size) {
    Film film(region.size.x, region.size.y, region.passes.first);
    for (uint32_t pass = region.passes.first; pass < region.passes.end(); ++pass) {
        film.beginPass();
        for (uint32_t y = 0; y < region.size.y; ++y) {
            for (uint32_t x = 0; x < region.size.x; ++x)
                film.add(y * region.size.x + x, meanOf((region.offset.y + y) * size.x + region.offset.x + x, pass));
        }
        film.finishPass();
    }
    EXPECT_EQ(film.passes(), region.passes);
    return { region, film.takeNodes(), 1, 0, 0.5 };
}

TEST(Merge, OfAnyDivisionHasTheBitsOfAnUndividedFilm) {
    std::mt19937 random(7);
    for (int trial = 0; trial < 60; ++trial) {
        const uint2 size(1 + random() % 7, 1 + random() % 5);
        const PassPlan plan{ 1, 2 + static_cast<uint32_t>(random() % 40) };
        const FilmRegion all{ { 0, 0 }, size, { 0, plan.passes } };
        ReferenceImage whole;
        Film film(size.x, size.y, { 0, plan.passes }, exposed(all, size).nodes);
        film.develop(whole);
        std::vector<FilmRegion> regions = randomParts(all, random);
        std::ranges::shuffle(regions, random);
        std::ranges::stable_sort(regions, {}, [](FilmRegion const& each) { return each.passes.first; });
        FilmMerger merger(size, plan);
        for (FilmRegion const& region : regions) merger.add(exposed(region, size));
        const ReferenceImage merged = merger.finish();
        EXPECT_EQ(merged.color, whole.color) << trial;
        EXPECT_EQ(merged.standardError, whole.standardError) << trial;
        EXPECT_EQ(merged.statistics.relativeError, whole.statistics.relativeError) << trial;
        EXPECT_EQ(merged.statistics.rays, regions.size());
    }
}

/// Adding the passes one after the other is what parts cannot repeat: these numbers notice.
TEST(Merge, NeedsTheOrderOfPairs) {
    size_t different = 0;
    for (size_t pixel = 0; pixel < 100; ++pixel) {
        const auto sum = [pixel](uint32_t first, uint32_t end) {
            double3 total(0.0);
            for (uint32_t pass = first; pass < end; ++pass) total += meanOf(pixel, pass);
            return total;
        };
        different += sum(0, 16) != sum(0, 8) + sum(8, 16);
    }
    EXPECT_GT(different, 50u);
}

const ReferenceView kView = viewFrom({ 2, 1.5, 3 }, { 0, 0.3, 0 }, { 20, 12 }, 40);

TracedScenePtr ballUnderTheSky(jobs::JobSystem& jobs) {
    ReferenceScene scene{ .models = { { makeModel(spherePrimitive(16), metal(0.4f, { 0.9f, 0.6f, 0.3f })) } } };
    scene.environment = { .image = makeSky(16, [](double3 d) { return float3(double3(0.2, 0.3, 0.4) * (1.5 + d.y)); }),
                          .illuminance = Lux{ 1 } };
    Result<TracedScenePtr> traced = prepare(scene, jobs);
    EXPECT_TRUE(traced.ok());
    return std::move(*traced);
}

TEST(RenderPart, InAnyDivisionMergesToTheBitsOfRender) {
    jobs::JobSystem jobs({ .workers = 1 });
    const TracedScenePtr scene = ballUnderTheSky(jobs);
    const ReferenceSettings settings{ .samplesPerPixel = 40 }; // 20 passes
    const Result<ReferenceImage> whole = render(*scene, kView, settings, jobs);
    ASSERT_TRUE(whole.ok());
    const PassPlan plan = planOf(settings);
    ASSERT_EQ(plan.passes, 20u);
    std::mt19937 random(3);
    for (int trial = 0; trial < 5; ++trial) {
        std::vector<FilmRegion> regions = randomParts({ { 0, 0 }, kView.size, { 0, plan.passes } }, random);
        std::ranges::stable_sort(regions, {}, [](FilmRegion const& each) { return each.passes.first; });
        FilmMerger merger(kView.size, plan);
        for (FilmRegion const& region : regions) {
            const Result<PartialFilm> part = renderPart(*scene, kView, settings, region, jobs);
            ASSERT_TRUE(part.ok()) << part.error().message;
            merger.add(*part);
        }
        const ReferenceImage merged = merger.finish();
        EXPECT_EQ(merged.color, whole->color) << trial;
        EXPECT_EQ(merged.standardError, whole->standardError) << trial;
        EXPECT_EQ(merged.statistics.rays, whole->statistics.rays) << trial;
        EXPECT_EQ(merged.statistics.samplesPerPixel, whole->statistics.samplesPerPixel);
    }
}

TEST(RenderPart, RefusesWhatIsNotInThePictureOrTooLargeForAFile) {
    jobs::JobSystem jobs({ .workers = 0 });
    const TracedScenePtr scene = ballUnderTheSky(jobs);
    const auto complaint = [&](uint2 size, FilmRegion const& region, uint32_t samples = 32) {
        ReferenceView view = kView;
        view.size = size;
        const auto part = renderPart(*scene, view, { .samplesPerPixel = samples }, region, jobs);
        return part ? "rendered" : part.error().message;
    };
    EXPECT_THAT(complaint({ 20, 12 }, { { 0, 0 }, { 21, 12 }, { 0, 16 } }), HasSubstr("not in the picture"));
    EXPECT_THAT(complaint({ 20, 12 }, { { 0, 0 }, { 20, 12 }, { 8, 9 } }), HasSubstr("passes 8 to 16 are not"));
    EXPECT_THAT(complaint({ 20, 12 }, {}), HasSubstr("not in the picture"));
    EXPECT_THAT(complaint({ 16384, 16384 }, { { 0, 0 }, { 16384, 16384 }, { 0, 16 } }), HasSubstr("smaller tiles"));
}

TEST(Division, OfShardsIsThePictureAndEachPartOnce) {
    const PassPlan plan{ 4, 16 };
    for (const uint2 size : { uint2(64, 48), uint2(7, 3), uint2(1, 1), uint2(1280, 720) }) {
        for (const uint32_t count : { 1u, 2u, 3u, 7u, 12u, 16u, 64u }) {
            if (count > size.x * size.y * plan.passes) continue;
            std::vector<FilmPart> parts;
            for (uint32_t i = 0; i < count; ++i) {
                const Result<FilmRegion> region = regionOf(tools::Shard{ i, count }, size, plan);
                if (!region) break; // 7 x 3 pixels have no 64 tiles
                PartHeader header{ .settings = { .size = size, .plan = plan }, .region = *region };
                header.shard = tools::Shard{ i, count };
                parts.push_back({ fmt::format("{}", i), header });
            }
            if (parts.empty()) continue;
            const Result<void> checked = checkParts(parts);
            EXPECT_TRUE(checked.ok()) << size.x << "x" << size.y << "/" << count << ": " << checked.error().message;
        }
    }
    EXPECT_EQ(regionOf(tools::Shard{ 5, 6 }, { 96, 54 }, plan).value(),
              (FilmRegion{ { 64, 27 }, { 32, 27 }, { 0, 16 } }))
            << "tiles first";
    EXPECT_EQ(regionOf(tools::Shard{ 5, 8 }, { 32, 32 }, plan).value(), (FilmRegion{ { 0, 16 }, { 16, 16 }, { 8, 8 } }))
            << "then passes";
    EXPECT_THAT(regionOf(tools::Shard{ 0, 17 }, { 1, 1 }, plan).error().message, HasSubstr("1x1 pixels and 16 passes"));
}

TEST(Division, ReadsTilesAndSamples) {
    const PassPlan plan{ 4, 16 };
    const uint2 size(64, 48);
    EXPECT_EQ(regionOf("8,4,16,2", "8,24", size, plan).value(), (FilmRegion{ { 8, 4 }, { 16, 2 }, { 2, 6 } }));
    EXPECT_EQ(regionOf("4/3x2", "", size, plan).value(), (FilmRegion{ { 21, 24 }, { 21, 24 }, { 0, 16 } }));
    for (const char* tile : { "8,4,16", "64,0,1,1", "0,0,65,1", "0,0,0,1", "6/3x2", "0/0x2", "0/65x1", "0/2", "a",
                              ",,,", "0,0,4294967295,1", "-1,0,2,2" })
        EXPECT_THAT(regionOf(tile, "", size, plan).error().message, HasSubstr("--tile")) << tile;
    for (const char* samples : { "0", "0,0", "1,4", "0,6", "64,4", "4,64", "x,y", "0,4,4" })
        EXPECT_THAT(regionOf("", samples, size, plan).error().message, HasSubstr("multiples of 4")) << samples;
}

/// Parts on disk, deleted with the test.
class MergeFiles : public ::testing::Test {
protected:
    MergeFiles() { std::filesystem::create_directories(mFolder); }
    ~MergeFiles() override { std::filesystem::remove_all(mFolder); }

    static PictureSettings settings() {
        return { .commit = "abc",
                 .arguments = { "m.glb", "--seed", "1", "--spp", "4" },
                 .contents = 5,
                 .size = { 6, 4 },
                 .plan = { 1, 4 } };
    }
    std::filesystem::path write(const char* name, FilmRegion const& region, PictureSettings const& with = settings(),
                                std::optional<tools::Shard> shard = {}) const {
        EXPECT_TRUE(writePart(mFolder / name, with, exposed(region, with.size), shard).ok());
        return mFolder / name;
    }
    static std::string complaintAbout(std::vector<std::filesystem::path> const& files) {
        const Result<MergedPicture> merged = mergeParts(files);
        return merged ? "merged" : merged.error().message;
    }
    void change(std::filesystem::path const& file, std::function<void(std::string&)> const& edit) const {
        std::ifstream in(file, std::ios::binary);
        std::string text{ std::istreambuf_iterator<char>(in), {} };
        edit(text);
        std::ofstream(file, std::ios::binary) << text;
    }

    std::filesystem::path mFolder =
            std::filesystem::temp_directory_path() / ("filament-merge-" + std::to_string(::getpid()));
    FilmRegion mTop{ { 0, 0 }, { 6, 2 }, { 0, 4 } }, mBottom{ { 0, 2 }, { 6, 2 }, { 0, 4 } };
};

TEST_F(MergeFiles, AreOnePictureInAnyOrderAndInFolders) {
    std::filesystem::create_directories(mFolder / "bottom");
    write("bottom/part.film", mBottom);
    const Result<MergedPicture> merged = mergeParts({ mFolder / "bottom", write("top", mTop) });
    ASSERT_TRUE(merged.ok()) << merged.error().message;
    EXPECT_EQ(merged->settings.arguments, settings().arguments);
    EXPECT_EQ(merged->image.statistics.rays, 2u);
    EXPECT_EQ(merged->image.statistics.seconds, 1);
}

TEST_F(MergeFiles, ThatAreMissingTwiceOrOverlappingAreNamed) {
    const auto top = write("top", mTop), bottom = write("bottom", mBottom), copy = write("copy", mTop);
    const auto overlap = write("overlap", { { 2, 1 }, { 2, 2 }, { 1, 2 } });
    EXPECT_EQ(complaintAbout({ top }), "no part has pixel 0,2 with --samples 0,4; render the part that is missing and "
                                       "merge again");
    EXPECT_THAT(complaintAbout({ top, bottom, copy }), HasSubstr("copy and " + top.string() + " are the same part"));
    EXPECT_THAT(complaintAbout({ bottom, overlap, top }), HasSubstr("overlap in pixels 2,1,2,1, passes 1 to 2"));
    const auto early = write("early", { { 0, 2 }, { 6, 2 }, { 0, 1 } });
    EXPECT_THAT(complaintAbout({ early, top }), HasSubstr("pixel 0,2 with --samples 1,3"));
    const auto right = write("right", { { 3, 2 }, { 3, 2 }, { 0, 4 } });
    EXPECT_THAT(complaintAbout({ right, top }), HasSubstr("pixel 0,2 with --samples 0,4"));
    EXPECT_THAT(complaintAbout({}), HasSubstr("give the files of all parts"));
    EXPECT_THAT(complaintAbout({ mFolder / "nothing" }), HasSubstr("nothing: "));
    const auto shard = write("shard", mTop, settings(), tools::Shard{ 0, 2 });
    EXPECT_EQ(complaintAbout({ shard }), "missing: shard 1/2; run --shard 1/2 and merge again");
}

TEST_F(MergeFiles, OfOtherPicturesAreRefusedWithWhatDiffers) {
    const auto top = write("top", mTop);
    const auto other = [&](auto const& edit) {
        PictureSettings changed = settings();
        edit(changed);
        return complaintAbout({ top, write("other", mBottom, changed) });
    };
    EXPECT_THAT(other([](PictureSettings& s) { s.arguments[2] = "2"; }),
                HasSubstr("'--seed 2' here, '--seed 1' there"));
    EXPECT_THAT(other([](PictureSettings& s) { s.arguments.resize(3); }), HasSubstr("nothing here, '--spp 4' there"));
    EXPECT_THAT(other([](PictureSettings& s) { s.commit = "def"; }), HasSubstr("another build: def here, abc there"));
    EXPECT_THAT(other([](PictureSettings& s) { s.contents = 6; }), HasSubstr("other contents"));
    EXPECT_THAT(other([](PictureSettings& s) { s.warnings = { "w" }; }), HasSubstr("other settings"));
    EXPECT_EQ(other([](PictureSettings&) {}), "merged");
}

TEST_F(MergeFiles, ThatAreDamagedAreRefusedWithTheCure) {
    const auto complaint = [&](std::function<void(std::string&)> const& edit) {
        const auto bottom = write("bottom", mBottom);
        change(bottom, edit);
        const std::string text = complaintAbout({ write("top", mTop), bottom });
        EXPECT_THAT(text, HasSubstr(bottom.string()));
        return text;
    };
    EXPECT_THAT(complaint([](std::string& t) { t.resize(t.size() - 9); }), HasSubstr("truncated: "));
    EXPECT_THAT(complaint([](std::string& t) { t.resize(60); }), HasSubstr("truncated; render this part again"));
    EXPECT_THAT(complaint([](std::string& t) { t.clear(); }), HasSubstr("no partial film"));
    EXPECT_THAT(complaint([](std::string& t) { t += "more"; }), HasSubstr("4 bytes follow its end"));
    EXPECT_THAT(complaint([](std::string& t) { t[t.size() - 100] ^= 1; }), HasSubstr("its hash is another"));
    EXPECT_THAT(complaint([](std::string& t) { t[8] = 9; }), HasSubstr("version 9 of partial films, not 1"));
    EXPECT_THAT(complaint([](std::string& t) { t[t.find("abc")] = 'x'; }), HasSubstr("do not have the hash"));
    EXPECT_THAT(complaint([](std::string& t) { t[16] = 'x'; }), HasSubstr("its header is damaged"));
}

TEST(FilmFile, SurvivesEditsAnywhere) {
    const FilmRegion region{ { 1, 0 }, { 2, 2 }, { 1, 3 } };
    const PictureSettings settings{
        .commit = "abc", .arguments = { "--spp", "4" }, .size = { 4, 2 }, .plan = { 1, 4 }
    };
    const std::vector<std::byte> original = bytesOf(settings, exposed(region, settings.size), tools::Shard{ 1, 3 });
    EXPECT_TRUE(test::fuzzFilmFile(original));
    std::mt19937 random(11);
    size_t refused = 0;
    for (int round = 0; round < 3000; ++round) {
        std::vector<std::byte> edited = original;
        const size_t at = random() % edited.size();
        switch (random() % 3) {
        case 0:
            edited[at] = static_cast<std::byte>(random());
            break;
        case 1:
            edited.erase(edited.begin() + static_cast<std::ptrdiff_t>(at));
            break;
        default:
            edited[16 + random() % 300] = static_cast<std::byte>("0123456789,[]{}\"-"[random() % 17]);
        }
        refused += !test::fuzzFilmFile(edited);
    }
    EXPECT_GT(refused, 2500u) << "every byte is hashed";
}

} // namespace
} // namespace filament_core::reference
