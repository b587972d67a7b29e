// SPDX-License-Identifier: Apache-2.0
// How much of an area of light is seen past what the shadow maps around its centre hold (AreaShadows::Shape). After
// Fernando 2005, "Percentage-Closer Soft Shadows", in the footprint of the shape itself: what is between the point and
// the shape gives the distance at which the lines to points of the shape are looked up. What a line meets there at
// another distance is looked up once more, at that one; it counts only if it hides a part of the shape (after Guennebaud,
// Barthe and Paulin 2006, "Real-Time Soft Shadow Mapping by Backprojection"). Lines cross the faces of the cube, so a
// light may be as long as it likes.

const int kOccluderLines = 16;
const int kAreaLines = 32;
const highp float kHalfTexel = 0.75; // and a little more than half of a diagonal: texels are not points
const highp float kLeastRise = 0.002; // of an occluder above the surface, over its distance: rounding of normals
const highp float kSameFraction = 0.02;
// Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences".
const highp vec2 kRobertsStep = vec2(0.754877666, 0.569840291);
const highp float kGoldenPart = 0.618033989;

struct AreaShadow {
    highp vec3 point;  // that is shaded, a quarter of a texel off its surface; from the light's centre, as all
    highp vec3 normal; // of the surface, on the side of the light
    highp vec3 facing; // its product with a place: distance from the plane of the light, over that of the point
    highp vec3 halfX, halfY;
    highp vec3 acrossX, acrossY; // over their squared length: the products of a point of the shape are in [-1, 1]
    highp vec2 inverse; // one over the lengths of the half edges
    highp float near;  // depths are this over the distance
    highp vec2 maps;   // PunctualLight::offset.yz
    int channel;
    bool isDisc;
};

// A point of the shape; `at`: in [0, 1)^2.
highp vec3 pointOfArea(AreaShadow area, highp vec2 at) {
    at = area.isDisc ? directionOfTurn(at.x) * sqrt(at.y) : at * 2.0 - 1.0;
    return area.halfX * at.x + area.halfY * at.y;
}

// What a direction from the centre meets: its distance from the plane of the light, as a fraction of the point's. 0: it
// is not in front of the point's surface, or hides nothing of the light.
highp float occluderTowards(AreaShadow area, highp vec3 direction) {
    highp float fraction = 0.0;
    int face = cubeFace(direction);
    int map = punctualMapOfFace(area.maps, face);
    if (map >= 0) {
        highp vec4 tile = shadowUniforms.maps[map].tile;
        highp float size = tile.z - tile.x;
        if (area.channel < int(shadowUniforms.maps[map].softness.y))
            tile.xy += vec2(float(area.channel & 1), float(area.channel >> 1)) * size;
        highp vec3 turned = inCubeFace(direction, face);
        highp float width = 2.0 * kFaceTangent / size;
        highp vec2 texel = clamp(floor(turned.xy / (turned.z * width) + 0.5 * size), vec2(0.0), vec2(size - 1.0));
        highp float stored = texelFetch(passShadowMaps, ivec2(tile.xy + texel), 0).x;
        highp vec3 ahead = fromCubeFace(vec3((texel + (0.5 - 0.5 * size)) * width, 1.0), face);
        if (stored > 0.0) {
            highp float depth = area.near / stored;
            highp vec3 occluder = ahead * depth;
            highp vec3 away = occluder - area.point;
            highp float rise = dot(area.normal, away);
            highp float part = dot(area.facing, occluder);
            highp vec3 hidden = hiddenPoint(area.point, occluder, part);
            highp float blur = kHalfTexel * width * depth / (1.0 - part); // of the texel on the light, metres
            highp vec2 at = abs(vec2(dot(hidden, area.acrossX), dot(hidden, area.acrossY))) / (area.inverse * blur + 1.0);
            highp float outside = area.isDisc ? sqrt(dot(at, at)) : max(at.x, at.y);
            bool isAbove = rise > 0.0 && rise * rise > kLeastRise * kLeastRise * dot(away, away);
            if (isAbove && part > 0.0 && part < 1.0 && outside <= 1.0) fraction = part;
        }
    }
    return fraction;
}

// The part of the light of the shape that arrives, [0, 1]: of a surface that faces the light as the triangle does.
// One loop for both kinds of lines, the first of which find the mean of what hides the shape: the code of a line is long,
// and is there once.
highp float visibilityOfShape(AreaShadow area) {
    highp float noise = interleavedGradientNoise(floor(gl_FragCoord.xy));
    highp vec2 at = fract(noise * vec2(1.0, 7.31));
    highp float square = max(dot(area.point, area.point), 1e-30);
    highp float found = 0.0, sum = 0.0, seen = 0.0, all = 0.0;
    highp float fraction = 1.0;
    int line = 0, end = kOccluderLines;
    bool isAgain = false; // the line, at the distance of what it met before
    while (line < end) {
        bool isSearch = line < kOccluderLines;
        if (!isAgain) {
            at = fract(at + kRobertsStep);
            noise = fract(noise + kGoldenPart);
            fraction = isSearch ? 0.03 + 0.94 * noise : found / sum;
        }
        highp vec3 onArea = pointOfArea(area, at);
        highp float met = occluderTowards(area, mix(onArea, area.point, fraction));
        isAgain = !isSearch && !isAgain && met > 0.0 && abs(met - fraction) > kSameFraction;
        fraction = met;
        if (!isAgain) {
            if (isSearch) {
                found += met > 0.0 ? 1.0 : 0.0;
                sum += met > 0.0 ? 1.0 / met : 0.0; // less one: the penumbra's width over that of the light
                if (line == kOccluderLines - 1 && found > 0.0) end += kAreaLines;
            } else {
                highp vec3 away = onArea - area.point;
                highp float nearness = square / max(dot(away, away), 1e-6 * square);
                highp float weight = max(dot(area.normal, away), 0.0) * (nearness * nearness);
                all += weight;
                seen += met > 0.0 ? 0.0 : weight;
            }
            ++line;
        }
    }
    return all > 0.0 ? seen / all : 1.0;
}

// Of each colour, from this fragment.
highp vec3 areaVisibility(AreaLight light, highp vec2 maps) {
    highp vec3 visibility = vec3(1.0);
    int first = int(maps.x) - 1;
    int end = first < 0 ? first : first + bitCount(int(maps.y) & 63);
    int channels = 0;
    for (int map = first; map < end; ++map) channels = max(channels, int(shadowUniforms.maps[map].softness.y));
    if (channels > 0) {
        highp vec3 normal = dot(shading_facet, light.center) < 0.0 ? -shading_facet : shading_facet;
        highp vec3 size = abs(light.center);
        highp float texel = shadowUniforms.maps[first].texel.y * max3(size);
        highp vec3 across = cross(light.halfX, light.halfY);

        AreaShadow area;
        area.point = normal * (kNormalBias * texel) - light.center;
        area.near = shadowUniforms.maps[first].atlasFromWorld[3].z;
        area.normal = normal;
        highp float distance = dot(across, area.point);
        area.facing = across / (abs(distance) > 1e-30 ? distance : 1e-30);
        area.halfX = light.halfX;
        area.halfY = light.halfY;
        highp vec2 squares = vec2(dot(light.halfX, light.halfX), dot(light.halfY, light.halfY));
        area.inverse = 1.0 / sqrt(max(squares, vec2(1e-30)));
        area.acrossX = light.halfX * (area.inverse.x * area.inverse.x);
        area.acrossY = light.halfY * (area.inverse.y * area.inverse.y);
        area.isDisc = light.isDisc;
        area.maps = maps;
        for (area.channel = 0; area.channel < channels; ++area.channel) {
            highp float share = visibilityOfShape(area);
            if (area.channel == 0) visibility = vec3(share);
            if (area.channel == 1) visibility.g = share;
            if (area.channel == 2) visibility.b = share;
        }
    }
    return visibility;
}
