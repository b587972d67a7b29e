// SPDX-License-Identifier: Apache-2.0
// The images that lights project and areas show: a share of the light for each colour. The images of a view are words of
// FroxelBuffer (shader::ImagedLight), so that materials need no sampler for them. quality_lightImages is 0 in a view
// without such lights, and then none of this is in the program. Loops keep the programs small: code is there once.
// filament_core/assets/tables/LightImageTable.h writes the tables.

const int kLightCookies = 1; // shader::LightImageTerms
const int kAreaImages = 2;
const float kImageOctahedral = 1.0; // shader::ImageMapping
const float kImageTiled = 2.0;

// Between four texels of a level, or of each of two. at: [0, 1] over the image. level: >= 0. A level has one more texel on
// each side. Texels are RGB9E5.
highp vec3 imageAt(int table, highp vec2 at, highp float level) {
    int last = int(froxelBuffer.words[table + 2]);
    int upper = int(level);
    highp float part = level - float(upper);
    int texels = part > 0.0 && upper < last ? 8 : 4;
    highp vec3 color = vec3(0.0);
    for (int i = 0; i < texels; ++i) {
        int which = min(upper + (i >> 2), last);
        int width = max(int(froxelBuffer.words[table]) >> which, 1);
        int height = max(int(froxelBuffer.words[table + 1]) >> which, 1);
        highp float x = at.x * float(width) + 0.5;
        highp float y = at.y * float(height) + 0.5;
        int column = clamp(int(x), 0, width) + (i & 1);
        int row = clamp(int(y), 0, height) + ((i >> 1) & 1);
        highp float share = (1.0 - abs(x - float(column))) * (1.0 - abs(y - float(row)));
        if (texels == 8) share *= i < 4 ? 1.0 - part : part;
        uint bits = froxelBuffer.words
                [table + int(froxelBuffer.words[table + kImageHeaderWords + which]) + row * (width + 2) + column];
        share *= uintBitsToFloat(((bits >> 27u) + 103u) << 23u);
        color += vec3(float(bits & 511u), float((bits >> 9u) & 511u), float((bits >> 18u) & 511u)) * share;
    }
    return color;
}

// Of a cookie, the place at which it is seen, in xy, and texels that are averaged, in z; -1: it is dark.
// imaged: the ImagedLight. from: from a lamp to the point, of any length; for suns the point. width: metres of the image
// that are averaged.
highp vec3 placeOnCookie(int imaged, highp vec3 from, highp float width) {
    highp vec4 point = vec4(from, 1.0);
    highp vec3 to = vec3(dot(lightBuffer.lights[imaged].positionRange, point),
            dot(lightBuffer.lights[imaged].colorIntensity, point), dot(lightBuffer.lights[imaged].directionScale, point));
    highp vec4 more = lightBuffer.lights[imaged].offset;
    bool isOctahedral = more.y == kImageOctahedral;
    // The octahedral map (Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors") around
    // z divides by the sum of all; a projection by z, which is 1 for a tiled image.
    highp float depth = isOctahedral ? 2.0 * (abs(to.x) + abs(to.y) + abs(to.z)) : to.z;
    highp float scale = 1.0 / max(depth, 1e-20);
    highp vec2 at = vec2(to.x, to.y) * scale;
    if (more.y == kImageTiled) at = fract(at);
    if (isOctahedral) {
        highp vec2 away = 0.5 - abs(vec2(at.y, at.x)); // behind, over the edges of the half in front
        if (to.z < 0.0) at = vec2(at.x < 0.0 ? -away.x : away.x, at.y < 0.0 ? -away.y : away.y);
        at += 0.5;
    }
    bool isInside = depth > 0.0 && max(abs(at.x - 0.5), abs(at.y - 0.5)) <= 0.5;
    return vec3(at, isInside ? more.z * width * scale : -1.0);
}
