// SPDX-License-Identifier: Apache-2.0
// The HTML report of filament-bake: everything that the bake measured is on the page, and its images are in it.
#include "filament_core/assets/image/ImageWriter.h"
#include "tests/tools/bake/BakeRun.h"
#include "toolkit/interiors/Interiors.h"

#include <gmock/gmock.h>

#include <string_view>

namespace filament_core::bake {
namespace {

using ::testing::HasSubstr;

size_t countOf(std::string_view text, std::string_view part) {
    size_t count = 0;
    for (size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

/// The number before " % off" in the caption that begins so.
double errorOf(std::string const& html, std::string_view caption) {
    const size_t begin = html.find(std::string("<figcaption>").append(caption)), end = html.find(" % off", begin);
    if (begin == std::string::npos || end == std::string::npos) return -1;
    return std::stod(html.substr(html.rfind(' ', end - 1)));
}

class BakeReport : public test::BakeRun {
protected:
    void SetUp() override {
        BakeRun::SetUp();
        write("cornell.glb", interiors::cornellBox().model);
    }
    std::string pageOf(std::string const& arguments, std::string const& environment = {}) {
        const Outcome outcome = shell(environment + " '" + program() + "' cornell.glb --size 64x64 --spp 8 " +
                                      arguments + " --report page/report.html --out out");
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        mText = outcome.text;
        const std::string html = read("page/report.html");
        EXPECT_EQ(countOf(html, "<img"), countOf(html, "src=\"data:image/png;base64,iVBORw0KGgo"));
        return html;
    }
    std::string mText;
};

TEST_F(BakeReport, ListsEveryChartAndShowsThatALightmapIsNearerToThePathTracer) {
    const std::string html = pageOf("--density 4 --samples 64");
    EXPECT_EQ(countOf(html, "<img"), 5u) << "three of the scene, the light and its error";
    const std::string report = read("out/report.json");
    EXPECT_EQ(countOf(html, "<tr>") - 1, countOf(report, "\"triangles\"")) << "a row for each chart";
    EXPECT_THAT(html, HasSubstr("traced for comparison alone"));
    const double before = errorOf(html, "Before"), after = errorOf(html, "After");
    ASSERT_GT(after, 0);
    EXPECT_LT(after * 2, before);
}

TEST_F(BakeReport, ListsEveryProbeAndEveryLeakOfAGrid) {
    std::ofstream(mFolder / "grid.json") << R"({"name": "box", "at": [0, 1, 0], "halfExtent": [1.2, 0.9, 0.9],
        "spacing": 1, "maxProbes": 60, "maxError": 0.3, "paths": 64, "depthSize": 0, "heldOut": 8, "leakPoints": 2})";
    const std::string html = pageOf("--grid grid.json");
    EXPECT_EQ(countOf(html, "<img"), 6u);
    const std::string report = read("out/box-report.json");
    const auto numberAfter = [&](std::string_view key) {
        return std::stoul(report.substr(report.find(key) + key.size()));
    };
    EXPECT_THAT(html, HasSubstr("points judge the grid alone"));
    const size_t probes = countOf(html.substr(html.find("<h3>Probes")), "<tr>") - 1;
    const size_t leaks = countOf(html, "<tr>") - probes - 2;
    EXPECT_GE(probes, 8u);
    EXPECT_EQ(leaks, numberAfter("\"found\": "));
    EXPECT_GT(errorOf(html, "Before"), 0);
}

// A box that a sky lights through its open front: what is deep inside sees little of it.
TEST_F(BakeReport, ShowsThatOcclusionIsNearerToThePathTracer) {
    write("cornell.glb", interiors::cornellBox(0).model);
    assets::HdrImage sky{ .width = 8, .height = 4 };
    for (uint32_t i = 0; i < 32; ++i) sky.pixels.push_back(i < 16 ? float3(0.5f, 0.6f, 0.9f) : float3(0.15f));
    ASSERT_TRUE(assets::writeHdr(mFolder / "sky.hdr", sky));
    for (const char* kind : { "texture", "vertex" }) {
        const std::string html =
                pageOf(std::string("--environment sky.hdr --density 6 --samples 64 --eye 0 1 4 --at 0 1 0 "
                                   "--fov 38 --occlusion ") +
                       kind);
        EXPECT_THAT(html, HasSubstr("<h1>Ambient occlusion of cornell.glb</h1>"));
        const double before = errorOf(html, "Before"), after = errorOf(html, "After");
        ASSERT_GT(after, 0);
        EXPECT_LT(after * (kind == std::string("texture") ? 3 : 2), before) << kind << ": " << after;
    }
}

TEST_F(BakeReport, IsWrittenWithoutADevice) {
    const std::string none = "VK_DRIVER_FILES=/none VK_ICD_FILENAMES=/none __EGL_VENDOR_LIBRARY_FILENAMES=/none";
    const std::string html = pageOf("--density 4 --samples 32", none);
    EXPECT_EQ(countOf(html, "<img"), 3u) << "traced, the light and its error";
    EXPECT_THAT(html, HasSubstr("The engine drew no image"));
    EXPECT_THAT(mText, HasSubstr("the report has no images of the engine"));
}

} // namespace
} // namespace filament_core::bake
