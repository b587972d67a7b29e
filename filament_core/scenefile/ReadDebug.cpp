// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scenefile/ReadDebug.h"

#include <glm/ext/matrix_transform.hpp>

namespace filament_core::scenefile {
namespace {

constexpr double kFarthestDrawn = 1e6;

DebugDepth readDepth(JsonReader& reader) {
    bool through = false;
    reader.read("through", through);
    return through ? DebugDepth::Through : DebugDepth::Tested;
}

DebugStyle readStyle(JsonReader& reader) {
    DebugStyle style;
    reader.read("color", style.color);
    reader.read("width", style.widthPixels, 0.1, 64);
    style.depth = readDepth(reader);
    return style;
}

void readLine(JsonReader& reader, DebugDraw& draw) {
    double3 from(0.0), to(0.0);
    bool isOnScreen = false;
    reader.read("from", from);
    reader.read("to", to);
    reader.read("screen", isOnScreen);
    const DebugStyle style = readStyle(reader);
    if (isOnScreen)
        draw.screenLine(float2(from), float2(to), style);
    else
        draw.line(from, to, style);
}

void readBox(JsonReader& reader, DebugDraw& draw) {
    Box box{ double3(-1.0), double3(1.0) };
    reader.read("min", box.min);
    reader.read("max", box.max);
    draw.box(box, readStyle(reader));
}

void readSphere(JsonReader& reader, DebugDraw& draw) {
    double3 at(0.0);
    double radius = 1;
    reader.read("at", at);
    reader.read("radius", radius, 0, kFarthestDrawn);
    draw.sphere(at, radius, readStyle(reader));
}

void readAxes(JsonReader& reader, DebugDraw& draw) {
    double3 at(0.0);
    double length = 1;
    float width = 2;
    reader.read("at", at);
    reader.read("length", length, 0, kFarthestDrawn);
    reader.read("width", width, 0.1, 64);
    draw.axes(glm::translate(double4x4(1.0), at), length, width, readDepth(reader));
}

void readFrustum(JsonReader& reader, DebugDraw& draw) {
    double3 eye(0, 0, 1), at(0.0);
    Lens lens{ .nearMeters = 0.1f };
    float aspect = 1;
    double far = 1;
    reader.read("eye", eye);
    reader.read("at", at);
    reader.read("fovDegrees", lens.verticalFovDegrees, 0.01, 179);
    reader.read("aspect", aspect, 0.01, 100);
    reader.read("far", far, 0, kFarthestDrawn);
    draw.frustum(Camera::lookAt(eye, at, lens), aspect, far, readStyle(reader));
}

void readText(JsonReader& reader, DebugDraw& draw) {
    double3 at(0.0);
    std::string text;
    bool isOnScreen = false;
    DebugTextStyle style;
    reader.read("at", at);
    reader.read("text", text);
    reader.read("screen", isOnScreen);
    reader.read("color", style.color);
    reader.read("background", style.background);
    reader.read("pixels", style.pixels, 1, 16);
    style.depth = readDepth(reader);
    if (isOnScreen)
        draw.screenText(float2(at), text, style);
    else
        draw.text(at, text, style);
}

} // namespace

void readDebugDraw(JsonReader& reader, DebugDraw& draw) {
    reader.objects("lines", [&](JsonReader& r) { readLine(r, draw); });
    reader.objects("boxes", [&](JsonReader& r) { readBox(r, draw); });
    reader.objects("spheres", [&](JsonReader& r) { readSphere(r, draw); });
    reader.objects("axes", [&](JsonReader& r) { readAxes(r, draw); });
    reader.objects("frustums", [&](JsonReader& r) { readFrustum(r, draw); });
    reader.objects("texts", [&](JsonReader& r) { readText(r, draw); });
}

} // namespace filament_core::scenefile
