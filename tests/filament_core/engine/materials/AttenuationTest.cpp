// SPDX-License-Identifier: Apache-2.0
// Boxes of blue glass that absorb according to the light's path, and sheets with the colour that remains:
// AttenuationTest.glb of the glTF sample models, seen from far away in a white environment, compared with closed forms.
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/filament_core/engine/WhiteEnvironment.h"

#include <array>
#include <cmath>

namespace filament_core {
namespace {

// In the columns, boxes differ in length or in density; the rows state thickness and distance in four ways.
constexpr std::array<double, 5> kLengths{ 0.25, 0.5, 1, 1.5, 2 };
constexpr std::array<double, 5> kColumns{ -3.5, -2, 0, 2.5, 6 };
constexpr std::array<double, 4> kRowsOfBoxes{ 3, 0, -3, -6 };
constexpr double kRowOfSheets = 6;
const double3 kLeftAfterOneMetre(0.1, 0.5, 0.9);
constexpr double kReflected = 0.04; // of index 1.5, head on

constexpr double kTolerance = 1; // byte: rounding is half a step; a tenth more glass changes up to seven

constexpr uint32_t kSize = 320;
constexpr double2 kCenter(1.5, 0);
constexpr double kHalfSide = 8.5, kAway = 300; // metres: at this distance all views are within 2 degrees of the axis

View viewOfAll() {
    const double degrees = glm::degrees(2 * std::atan(kHalfSide / kAway));
    View view{ .camera = Camera::lookAt({ kCenter.x, kCenter.y, kAway }, { kCenter.x, kCenter.y, 0 },
                                        { .verticalFovDegrees = static_cast<float>(degrees) }),
               .size = { kSize, kSize } };
    view.display.toneMapper = ToneMapper::Linear;
    view.quality.refraction = RefractionSource::Environment; // its sky is white: colours are those of glass alone
    return view;
}

// In bytes of sRGB.
double3 pixelAt(Image const& image, double x, double y) {
    const auto toPixels = [](double offset) { return static_cast<uint32_t>((offset / kHalfSide + 1) / 2 * kSize); };
    return double3(test::bytePixel(image, toPixels(x - kCenter.x), toPixels(kCenter.y - y))) * 255.0;
}

// IEC 61966-2-1.
double3 srgbBytes(double3 linear) {
    double3 bytes;
    for (int i = 0; i < 3; ++i) {
        const double c = linear[i];
        bytes[i] = 255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
    }
    return bytes;
}

// Beer 1852: equal lengths transmit equal fractions.
double3 leftAfter(double metres) { return glm::pow(kLeftAfterOneMetre, double3(metres)); }

// One interface and the rest of the light: the engine treats a box as a ball that light enters and leaves once.
double3 boxColor(double metres) { return kReflected + (1 - kReflected) * leftAfter(metres); }

// Two interfaces, the bounces between them, and a colour applied at each crossing. Stokes 1862.
double3 sheetColor(double3 tint) {
    const double3 series = 1.0 / (1.0 - kReflected * kReflected * tint * tint);
    const double both = (1 - kReflected) * (1 - kReflected);
    return kReflected + both * (tint + kReflected * tint * tint) * series;
}

void expectColor(double3 seen, double3 expected, std::string const& where) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(seen[i], expected[i], kTolerance) << where << ", component " << i;
}

class AttenuationTest : public testing::TestWithParam<Backend> {};

TEST_P(AttenuationTest, BoxesAndSheetsAreAsDeepAsBeersLawSays) {
    if (tools::assetDir().empty())
        GTEST_SKIP() << "FILAMENT_ASSET_DIR is not set: the models are not beside the checkout";
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    const auto model = loadGltf(*engine, tools::assetDir() / "models/AttenuationTest/AttenuationTest.glb");
    ASSERT_TRUE(model) << model.error().message;
    const View view = viewOfAll();
    const WhiteEnvironment environment(*engine);
    Scene scene(*engine);
    environment.light(scene, view.camera);
    scene.add(*model);
    Renderer renderer(*engine);
    const auto image = renderer.renderToImage(scene, view);
    ASSERT_TRUE(image) << image.error().message;
    for (size_t i = 0; i < kLengths.size(); ++i) {
        const std::string length = std::to_string(kLengths[i]) + " m";
        for (const double row : kRowsOfBoxes) {
            expectColor(pixelAt(*image, kColumns[i], row), srgbBytes(boxColor(kLengths[i])),
                        length + ", row at " + std::to_string(row));
        }
        expectColor(pixelAt(*image, kColumns[i], kRowOfSheets), srgbBytes(sheetColor(leftAfter(kLengths[i]))),
                    length + ", sheet");
    }
    test::expectNoErrors(*engine);
}

INSTANTIATE_TEST_SUITE_P(BothApis, AttenuationTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament_core
