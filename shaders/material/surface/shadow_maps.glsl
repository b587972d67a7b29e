// SPDX-License-Identifier: Apache-2.0
// Filters of shadow maps, for any point. Who includes this defines what it has of the point: shadowReceiver(), the point
// in the space of a map, and shadowOf(), the filter of its choice.
//
// Depths are reversed: 0 is background, however far a plane extends beyond.
//
// Where some caster lets light through (Quality::coloredShadows), each colour channel has a map of its own, in which
// the caster fills as many texels as it stops of that colour (McGuire and Enderton 2011, "Colored Stochastic Shadow
// Maps").

#include "shaders/lib/area_shadows.glsl"

const int kShadowVsm = 7;
const int kShadowEvsm = 8;
const int kShadowsOfShapes = 9; // added to filters that compare: areas have shadows of their shape (area_shadows.glsl)
const highp float kFilterReach = 3.0; // texels around a point that the widest filter of fixed width reads
const highp float kLastMomentLevel = 4.0;

int shadowFilter() {
    return quality_shadowFilter >= kShadowsOfShapes ? quality_shadowFilter - kShadowsOfShapes : quality_shadowFilter;
}

// A point in the space of a map.
struct ShadowReceiver {
    highp vec2 texel;  // of the atlas
    highp float depth; // of the receiving plane at this point, biased
    highp vec2 slope;  // of the plane: change of depth a texel
    highp vec4 tile;
    highp vec4 softness; // ShadowMapRecord
    highp float pixel;   // width of the pixel in texels
    bool isInside;       // all of a filter is
};

ShadowReceiver shadowReceiver(int map, highp vec3 toLight);
highp float shadowOf(ShadowReceiver receiver);

// How far what is in a texel lies in front of the plane, in depth; 0 or less: behind it.
highp float blockerInTexel(ShadowReceiver receiver, highp vec2 at) {
    highp vec2 texel = clamp(floor(at), receiver.tile.xy, receiver.tile.zw - 1.0);
    highp float plane = receiver.depth + dot(receiver.slope, texel + 0.5 - receiver.texel);
    return texelFetch(passShadowMaps, ivec2(texel), 0).x - max(plane, 0.0);
}

// 1: nothing nearer to the light is in the texel.
highp float shadowOfTexel(ShadowReceiver receiver) {
    return blockerInTexel(receiver, receiver.texel) > 0.0 ? 0.0 : 1.0;
}

// The weights of two neighbours in a row of 2 `pairs` texels; the point is `s` of a texel behind the centre of the one
// before the middle. Bilinear comparisons summed with the weights of a tent: Castano 2013, "Shadow Mapping Summary",
// part 1, spelled out for single texels. Both axes together sum up to 1.
highp vec2 tentWeights(highp float s, int pair, int pairs) {
    highp vec2 weights = vec2(1.0 - s, s);
    if (pairs == 2) weights = (pair == 0 ? vec2(1.0 - s, 2.0 - s) : vec2(1.0 + s, s)) * 0.25;
    if (pairs == 3) {
        weights = pair == 0 ? vec2(1.0 - s, 3.0 - 2.0 * s) : vec2(1.0 + 2.0 * s, s);
        if (pair == 1) weights = vec2(4.0 - s, 3.0 + s);
        weights *= 1.0 / 12.0;
    }
    return weights;
}

highp float shadowOfTent(ShadowReceiver receiver, int pairs) {
    highp vec2 corner = floor(receiver.texel - 0.5);
    highp vec2 s = receiver.texel - 0.5 - corner;
    highp vec2 first = clamp(corner - float(pairs - 1), receiver.tile.xy, receiver.tile.zw - 2.0 * float(pairs));
    highp float dark = 0.0; // the sum of what is shadowed: without shadow it is exactly 0
    for (int row = 0; row < pairs; ++row) {
        highp vec2 weightsY = tentWeights(s.y, row, pairs);
        for (int column = 0; column < pairs; ++column) {
            highp vec2 weightsX = tentWeights(s.x, column, pairs);
            // A gather at the corner of four texels: (0, 1), (1, 1), (1, 0), (0, 0).
            highp vec2 corners = first + 2.0 * vec2(float(column), float(row)) + 1.0;
            highp vec4 stored = textureGather(passShadowMaps, corners * shadowUniforms.atlas.x);
            highp float plane = receiver.depth + dot(receiver.slope, corners - receiver.texel);
            highp vec2 rise = receiver.slope * 0.5;
            highp vec4 planes = max(plane + vec4(rise.y - rise.x, rise.x + rise.y, rise.x - rise.y, -rise.x - rise.y),
                    vec4(0.0));
            highp vec4 shadowed = vec4(stored.x > planes.x ? 1.0 : 0.0, stored.y > planes.y ? 1.0 : 0.0,
                    stored.z > planes.z ? 1.0 : 0.0, stored.w > planes.w ? 1.0 : 0.0);
            dark += weightsY.y * (weightsX.x * shadowed.x + weightsX.y * shadowed.y) +
                    weightsY.x * (weightsX.x * shadowed.w + weightsX.y * shadowed.z);
        }
    }
    return dark > 0.99999 ? 0.0 : 1.0 - dark; // and in full shadow the light is
}

#if defined(HAS_SHADOW_MOMENTS)

// From the mip levels whose texels are as wide as this pixel. Nothing beyond the tile is read: on each level it ends
// half a texel before its edge.
highp float shadowOfBlurred(ShadowReceiver receiver) {
    highp float level = clamp(log2(receiver.pixel), 0.0, kLastMomentLevel);
    highp float halfTexel = 0.5 * exp2(ceil(level));
    highp vec2 at = clamp(receiver.texel, receiver.tile.xy + halfTexel, receiver.tile.zw - halfTexel);
    highp vec4 moments = textureLod(passShadowMaps, at * shadowUniforms.atlas.x, level);

    // The plane's own depths within the filter: they must not darken it.
    highp float depth = momentDepth(receiver.depth, receiver.softness.z);
    highp vec2 slope = momentSlope(depth, receiver.softness.z) * receiver.slope;
    highp float blur = receiver.softness.w, width = exp2(level);
    highp float reach = (blur + 2.0 * width) * (abs(slope.x) + abs(slope.y));
    depth = clamp(depth, -1.0, max(1.0 - reach, -1.0)); // what is cut off at the far end would have been farther
    highp float spread = dot(slope, slope) * (blur * (blur + 2.0) + 1.5 * width * width) * (1.0 / 6.0);
    return shadowFilter() == kShadowVsm ? shadowOfMoments(moments.xy, depth)
                                              : shadowOfWarpedMoments(moments, depth, spread);
}

#else

highp float shadowOfBlurred(ShadowReceiver receiver) { return 1.0; }

#endif

ShadowReceiver inChannel(ShadowReceiver receiver, int channel) {
    highp vec2 step = (receiver.tile.zw - receiver.tile.xy) * vec2(float(channel & 1), float(channel >> 1));
    receiver.texel += step;
    receiver.tile += step.xyxy;
    return receiver;
}

// A loop even for one channel: the filter's code is long, and is there once.
highp vec3 shadowOfChannels(ShadowReceiver receiver) {
    highp vec3 light = vec3(1.0);
    int channels = quality_coloredShadows != 0 ? int(receiver.softness.y) : 1;
    for (int channel = 0; channel < channels; ++channel) {
        highp float share = shadowOf(inChannel(receiver, channel));
        if (channel == 0) light = vec3(share);
        if (channel == 1) light.g = share;
        if (channel == 2) light.b = share;
    }
    return light;
}

// Through the maps from `first` to before `end`. Of a sun's cascades the first that contains the point counts, and beyond
// all of them there is no shadow; other lights have one map for a direction, or none. A loop for one map, too: see
// shadowOfPenumbra().
highp vec3 visibilityThrough(int first, int end, bool isSun, highp vec3 toLight) {
    highp vec3 light = vec3(1.0);
    for (int map = first; map < end; ++map) {
        ShadowReceiver receiver = shadowReceiver(map, toLight);
        if (!isSun || receiver.isInside) {
            light = shadowOfChannels(receiver);
            break;
        }
    }
    return light;
}

// The map of a face of a light that takes a cube; below 0: nothing casts there. `maps`: PunctualLight::offset.yz.
int punctualMapOfFace(highp vec2 maps, int face) {
    int bits = int(maps.y) & 63;
    return (bits >> face & 1) == 1 ? int(maps.x) - 1 + bitCount(bits & ((1 << face) - 1)) : -1;
}

// The map of a point, spot or area that holds a direction; below 0: nothing casts there.
int punctualMap(highp vec2 maps, highp vec3 fromLight) {
    int map = int(maps.x) - 1;
    if (map >= 0 && (int(maps.y) & 64) != 0) map = punctualMapOfFace(maps, cubeFace(fromLight));
    return map;
}

// Of the sun of the uniforms.
highp vec3 sunVisibility() {
    int first = int(shadowUniforms.sun.x);
    return visibilityThrough(first, first + int(shadowUniforms.sun.y), true, frameUniforms.sunDirection.xyz);
}

// Of a light of the list. `maps`: PunctualLight::offset.yz.
highp vec3 listedVisibility(highp vec2 maps, bool isSun, highp vec3 toLight) {
    int first = isSun ? int(maps.x) - 1 : punctualMap(maps, -toLight);
    int count = isSun ? bitCount(int(maps.y) & 15) : first >= 0 ? 1 : 0;
    return visibilityThrough(first, first + count, isSun, toLight);
}
