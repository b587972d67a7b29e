// SPDX-License-Identifier: Apache-2.0
#include "toolkit/interiors/Interiors.h"

#include "base/Assert.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "toolkit/interiors/RoomBuilder.h"

#include <fmt/format.h>

#include <cmath>

namespace filament_core::interiors {
namespace {

/// Of 60 cm a side and 1 m high, without a bottom.
assets::GlbPrimitive block(uint32_t material) {
    assets::GlbPrimitive primitive{ .material = material };
    const std::array<float3, 4> foot{ float3(-0.3f, 0, 0.3f), float3(0.3f, 0, 0.3f), float3(0.3f, 0, -0.3f),
                                      float3(-0.3f, 0, -0.3f) };
    const float3 up(0, 1, 0);
    for (size_t i = 0; i < 4; ++i) {
        const float3 a = foot[i], b = foot[(i + 1) % 4];
        addQuad(primitive, { a, b, b + up, a + up });
    }
    addQuad(primitive, { foot[0] + up, foot[1] + up, foot[2] + up, foot[3] + up });
    return primitive;
}

double4x4 placed(double3 at, double height, double radians) {
    double4x4 transform(1.0);
    const double c = std::cos(radians), s = std::sin(radians);
    transform[0] = { c, 0, -s, 0 };
    transform[1] = { 0, height, 0, 0 };
    transform[2] = { s, 0, c, 0 };
    transform[3] = double4(at, 1);
    return transform;
}

/// The gallery's own sizes: half the sides of the room, and its height.
class GalleryBuilder {
public:
    explicit GalleryBuilder(GalleryOptions const& options)
            : mOptions(options), mX(options.lengthMeters / 2), mZ(options.widthMeters / 2), mY(options.heightMeters) {}

    assets::GlbScene build() {
        addRoom();
        addColumns();
        addPictures();
        addPedestals();
        return mRoom.take();
    }

private:
    static constexpr double kWall = 0.2;

    void addRoom() {
        const uint32_t floor = mRoom.paint("floor", { 0.42f, 0.27f, 0.15f }, 0.5f),
                       red = mRoom.paint("red", { 0.62f, 0.09f, 0.07f }),
                       blue = mRoom.paint("blue", { 0.1f, 0.2f, 0.55f });
        const double panel = mOptions.panelMeters;
        const double3 x(2 * mX, 0, 0), y(0, mY, 0), z(0, 0, 2 * mZ), low(-mX, 0, -mZ);
        mRoom.add("floor", floor, { { low, z, x } }, panel);
        mRoom.add("ceiling", mWhite, { { low + y, x, z } }, panel);
        mRoom.add("red wall", red, { { low, y, z } }, panel);
        mRoom.add("blue wall", blue, { { low + x, z, y } }, panel);
        mRoom.add("back wall", mWhite, { { low, x, y } }, panel);
        const Rectangle front{ low + z, y, x };
        mRoom.add("front wall", mWhite, around(front, { kSill / mY, 0.2 }, { 1 - kLintel / mY, 0.8 }), panel);
        addOutside();
    }

    /// The reveal of the window, and the outer faces of the walls.
    void addOutside() {
        const double width = 0.6 * mX, bottom = kSill, top = mY - kLintel;
        const double3 in(-width, bottom, mZ), x(2 * width, 0, 0), y(0, top - bottom, 0), z(0, 0, kWall);
        mRoom.add("reveal", mWhite, { { in, z, x }, { in + y, x, z }, { in, y, z }, { in + x, z, y } }, 0);
        const double3 low(-mX - kWall, -kWall, -mZ - kWall), high(mX + kWall, mY + kWall, mZ + kWall);
        std::vector<Rectangle> sides = sidesOf(low, high);
        const Rectangle front = sides.back(); // towards +z, x before y
        sides.pop_back();
        const double2 size(high.x - low.x, high.y - low.y);
        const double2 from = (double2(-width, bottom) - double2(low)) / size;
        const double2 to = (double2(width, top) - double2(low)) / size;
        for (Rectangle const& part : around(front, from, to)) sides.push_back(part);
        mRoom.add("outside", mWhite, sides, 0);
    }

    void addColumns() {
        const auto height = static_cast<float>(mY);
        const float2 profile[] = { { 0.2f, 0 }, { 0.2f, height } };
        const showcase::Shape column = showcase::lathe(profile, 24);
        for (uint32_t i = 0; i < mOptions.columns; ++i)
            mRoom.add(fmt::format("column {}", i), mStone, column, { along(i, mOptions.columns), 0, mZ - 1.1 });
    }

    void addPictures() {
        const float3 colors[] = {
            { 0.75f, 0.6f, 0.1f }, { 0.08f, 0.4f, 0.25f }, { 0.5f, 0.12f, 0.35f }, { 0.15f, 0.45f, 0.65f }
        };
        const uint32_t frame = mRoom.paint("frame", { 0.12f, 0.08f, 0.05f }, 0.4f);
        for (uint32_t i = 0; i < mOptions.pictures; ++i) {
            const std::string name = fmt::format("picture {}", i);
            const uint32_t canvas = mRoom.paint(name.c_str(), colors[i % 4], 0.7f);
            const double x = along(i, mOptions.pictures), y = 1.2, z = -mZ,
                         half = 0.1 + 1.2 * mX / (3.0 + mOptions.pictures);
            mRoom.addBox(fmt::format("frame {}", i), frame, { x - half, y, z }, { x + half, y + 1.2, z + 0.06 });
            const Rectangle front{ { x - half + 0.08, y + 0.08, z + 0.065 },
                                   { 2 * half - 0.16, 0, 0 },
                                   { 0, 1.04, 0 } };
            mRoom.add(name, canvas, { front }, 0);
        }
    }

    void addPedestals() {
        constexpr uint32_t kPedestals = 3;
        const uint32_t metal = mRoom.paint("bronze", { 0.75f, 0.5f, 0.3f }, 0.35f, 1),
                       clay = mRoom.paint("clay", { 0.7f, 0.65f, 0.55f }, 0.6f);
        for (uint32_t i = 0; i < kPedestals; ++i) {
            const double x = along(i, kPedestals), z = -0.35 * mZ;
            mRoom.addBox(fmt::format("pedestal {}", i), mStone, { x - 0.25, 0, z - 0.25 }, { x + 0.25, 1, z + 0.25 });
            if (i % 2 == 0)
                mRoom.add(fmt::format("sphere {}", i), i == 0 ? metal : clay, showcase::sphere(0.24f, 32),
                          { x, 1.24, z });
            else
                mRoom.addBox(fmt::format("block {}", i), clay, { x - 0.15, 1, z - 0.2 }, { x + 0.15, 1.5, z + 0.2 });
        }
    }

    /// The middle of the part `i` of the room's length.
    double along(uint32_t i, uint32_t count) const { return (2 * (i + 0.5) / count - 1) * mX; }

    static constexpr double kSill = 0.9, kLintel = 0.7;
    GalleryOptions const& mOptions;
    const double mX, mZ, mY;
    RoomBuilder mRoom{ "gallery" };
    const uint32_t mWhite = mRoom.paint("white", float3(0.75f)),
                   mStone = mRoom.paint("stone", { 0.6f, 0.58f, 0.54f }, 0.8f);
};

} // namespace

Interior cornellBox(float lamp) {
    FILAMENT_ASSERT(lamp >= 0, "a lamp gives light");
    RoomBuilder room("cornell");
    const uint32_t white = room.paint("white", float3(0.73f)), red = room.paint("red", { 0.63f, 0.06f, 0.05f }),
                   green = room.paint("green", { 0.14f, 0.45f, 0.09f }), lit = room.paint("lamp", float3(0.0f));
    room.material(lit).emissiveFactor = { 1, 0.85f, 0.6f };
    room.material(lit).emissiveStrength = lamp;

    const double3 x(2, 0, 0), y(0, 2, 0), z(0, 0, 2), low(-1, 0, -1);
    room.add("shell", white, { { low + z, x, -z }, { low + y, x, z }, { low, x, y } }, 0);
    room.add("left", red, { { low + z, -z, y } }, 0);
    room.add("right", green, { { low + x, z, y } }, 0);
    const uint32_t shared = room.mesh("block", block(white));
    room.node("tall", shared, placed({ -0.35, 0, -0.3 }, 1.2, 0.3));
    room.node("low", shared, placed({ 0.35, 0, 0.3 }, 0.6, -0.3));
    if (lamp > 0) room.add("lamp", lit, { { { -0.3, 1.99, -0.3 }, { 0.6, 0, 0 }, { 0, 0, 0.6 } } }, 0);
    return { room.take(),
             { 0, 1, 0 },
             { 1, 1, 1 },
             { { { 0, 1, 3.4 }, { 0, 1, 0 }, 38 },
               { { 0.7, 1.5, 1.6 }, { -0.4, 0.6, -0.4 }, 50 },
               { { -0.8, 0.5, 0.8 }, { 0.6, 0.7, -0.6 }, 60 },
               { { 0.6, 1.7, -0.7 }, { -0.3, 0.2, 0.3 }, 60 },
               { { -0.6, 1.2, 1.2 }, { 0.5, 0.1, 0.1 }, 40 } } };
}

Interior gallery(GalleryOptions const& options) {
    FILAMENT_ASSERT(options.lengthMeters >= 6 && options.lengthMeters <= 60, "length in [6, 60] m");
    FILAMENT_ASSERT(options.widthMeters >= 4 && options.widthMeters <= 20, "width in [4, 20] m");
    FILAMENT_ASSERT(options.heightMeters >= 3 && options.heightMeters <= 10, "height in [3, 10] m");
    FILAMENT_ASSERT(options.columns <= 16 && options.pictures <= 16, "at most 16 columns and pictures");
    FILAMENT_ASSERT(options.panelMeters == 0 || (options.panelMeters >= 0.25 && options.panelMeters <= 60),
                    "panels of [0.25, 60] m, or 0");
    const double x = options.lengthMeters / 2, y = options.heightMeters, z = options.widthMeters / 2;
    return { GalleryBuilder(options).build(),
             { 0, y / 2, 0 },
             { x, y / 2, z },
             { { { 0.6 - x, 1.6, z - 0.6 }, { 0.4 * x, 1.3, -z }, 55 },
               { { x - 0.6, 1.6, 0.1 * z }, { -x, 1.4, -0.3 * z }, 50 },
               { { 0.1 * x, 1.6, 0.8 * z }, { -0.3 * x, 1.3, -z }, 60 },
               { { -0.5 * x, 1.7, 0.5 - z }, { 0.6 * x, 1.1, 0.6 * z }, 55 },
               { { x - 0.5, y - 0.6, 0.6 - z }, { -0.3 * x, 0, 0.2 * z }, 60 } } };
}

assets::HdrImage interiorSky() {
    assets::HdrImage sky{ .width = 64, .height = 32 };
    for (uint32_t y = 0; y < sky.height; ++y) {
        const float up = 1 - 2 * (static_cast<float>(y) + 0.5f) / static_cast<float>(sky.height);
        const float3 color =
                up > 0 ? float3(0.55f, 0.6f, 0.7f) - up * float3(0.3f, 0.2f, 0.05f) : float3(0.15f, 0.13f, 0.1f);
        for (uint32_t x = 0; x < sky.width; ++x) sky.pixels.push_back(color);
    }
    return sky;
}

Result<InteriorFiles> writeInterior(Interior const& interior, std::filesystem::path const& folder) {
    const Result<std::vector<std::byte>> model = assets::writeGlb(interior.model);
    if (!model) return model.error();
    InteriorFiles files{ folder / (interior.model.name + ".glb"), folder / (interior.model.name + ".hdr") };
    if (auto done = assets::replaceFile(files.model, *model); !done) return done.error();
    if (auto done = assets::writeHdr(files.sky, interiorSky()); !done) return done.error();
    return files;
}

} // namespace filament_core::interiors
