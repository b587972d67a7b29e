// SPDX-License-Identifier: Apache-2.0
// Screen-space reflections, for lit materials with `reflections : screenspace`: the mirrored ray is traced through
// the hierarchical depth buffer of opaque surfaces, cell by cell: cells that it crosses in front in one step, others
// subdivided down to pixels. The colour of a hit is the scene colour there: for opaque surfaces that of the previous
// frame, reprojected to this one.
//   After   McGuire and Mara 2014, "Efficient GPU Screen-Space Ray Tracing": lines on screen are walked, and what
//           is linear in the world is interpolated divided by w. Uludag 2014, "Hi-Z Screen-Space Cone-Traced
//           Reflections", GPU Pro 5: the hierarchical depth buffer.

const highp float kReflectionBorder = 0.08;     // of the screen, over which hits fade
const highp float kReflectionBias = 0.0009765625; // of the distance: tolerance for the same surface
const highp float kIntoNextCell = 0.03125; // pixels: beyond the border, despite rounding

#include "shaders/material/surface/scene_color_texel.glsl"

struct PictureHit {
    highp vec3 color; // pre-exposed
    highp float weight; // [0, 1]: how much of the reflection it is; the environment is the rest
    highp float meters; // along the ray
};

PictureHit noHit() { return PictureHit(vec3(0.0), 0.0, 0.0); }

// For DebugView::Reflections: red is -1 - metres, or -0.5 for a miss.
highp vec3 codeOfHit(PictureHit hit) { return vec3(hit.weight > 0.0 ? -1.0 - min(hit.meters, 6e4) : -0.5, 0.0, 0.0); }

// A ray as a line on screen.
struct PictureRay {
    highp vec2 start, along; // pixels: along: to where it ends
    highp vec2 w;            // 1 / w at both ends
    highp vec2 distances;    // along the view, over w
    highp float end;         // of the line that lies on screen, [0, 1]
};

highp vec2 pixelOfClip(highp vec4 clip) { return (clip.xy / clip.w * 0.5 + 0.5) * passUniforms.target.xy; }

// The part of [0, 1] on which start + along s lies within [0, size].
highp float insidePicture(highp float start, highp float along, highp float size) {
    highp float bound = along > 0.0 ? size : 0.0;
    highp float end = abs(along) > 1e-6 ? (bound - start) / along : 1.0;
    return clamp(end, 0.0, 1.0);
}

// `meters`: the length of the ray; less, where it would pass behind the camera.
PictureRay pictureRay(highp vec3 from, highp vec3 direction, inout highp float meters) {
    highp vec4 first = frameUniforms.clipFromWorld * vec4(from, 1.0);
    highp vec4 last = frameUniforms.clipFromWorld * vec4(from + direction * meters, 1.0);
    highp float least = first.w * 0.05; // towards the camera it ends there
    if (last.w < least) {
        highp float share = (first.w - least) / max(first.w - last.w, 1e-30);
        meters *= share;
        last = frameUniforms.clipFromWorld * vec4(from + direction * meters, 1.0);
    }
    PictureRay ray;
    ray.start = pixelOfClip(first);
    ray.along = pixelOfClip(last) - ray.start;
    ray.w = vec2(1.0 / first.w, 1.0 / last.w);
    ray.distances = vec2(alongView(from), alongView(from + direction * meters)) * ray.w;
    ray.end = min(insidePicture(ray.start.x, ray.along.x, passUniforms.target.x),
            insidePicture(ray.start.y, ray.along.y, passUniforms.target.y));
    return ray;
}

highp float distanceOfRay(PictureRay ray, highp float s) {
    return (ray.distances.x + (ray.distances.y - ray.distances.x) * s) / (ray.w.x + (ray.w.y - ray.w.x) * s);
}

// The nearest distance in a cell of a level.
highp float distanceOfCell(highp vec2 cell, int level) {
    ivec2 last = max(ivec2(passUniforms.target.xy) >> level, ivec2(1)) - 1; // it covers the remainder
    return texelFetch(passSceneDepth, clamp(ivec2(cell), ivec2(0), last), level).x;
}

// Where on the line the ray leaves a cell that is `width` pixels wide.
highp float endOfCell(PictureRay ray, highp vec2 cell, highp float width) {
    highp vec2 border = (cell + vec2(ray.along.x > 0.0 ? 1.0 : 0.0, ray.along.y > 0.0 ? 1.0 : 0.0)) * width;
    highp vec2 beyond = border - ray.start + vec2(ray.along.x > 0.0 ? kIntoNextCell : -kIntoNextCell,
                                                     ray.along.y > 0.0 ? kIntoNextCell : -kIntoNextCell);
    highp float x = abs(ray.along.x) > 1e-6 ? beyond.x / ray.along.x : 1.0;
    highp float y = abs(ray.along.y) > 1e-6 ? beyond.y / ray.along.y : 1.0;
    return min(x, y);
}

// Where on [begin, end] the ray reaches `distance`; begin, if it is farther there already.
highp float meetsDistance(PictureRay ray, highp float begin, highp float end, highp float distance) {
    highp float over = distance * ray.w.x - ray.distances.x;
    highp float under = (ray.distances.y - ray.distances.x) - distance * (ray.w.y - ray.w.x);
    return under > 0.0 ? clamp(over / under, begin, end) : begin;
}

// Where on the line the ray goes behind a surface; below 0: nowhere.
highp float hitOfRay(PictureRay ray) {
    int cells = int(passUniforms.reflection.x);
    highp float thickness = passUniforms.reflection.z;
    int last = int(passUniforms.reflection.w);
    // The ray starts in its own pixel: no hit.
    highp float begin = 1.0 / max(max(abs(ray.along.x), abs(ray.along.y)), 1e-6);
    highp float atBegin = distanceOfRay(ray, begin);
    highp float found = -1.0;
    int level = 0;
    for (int i = 0; i < cells; ++i) {
        if (begin >= ray.end) break;
        highp float width = float(1 << level);
        highp vec2 cell = floor((ray.start + ray.along * begin) / width);
        highp float end = min(max(endOfCell(ray, cell, width), begin), ray.end);
        highp float atEnd = distanceOfRay(ray, end);
        highp float nearest = distanceOfCell(cell, level);
        bool isBefore = max(atBegin, atEnd) <= nearest + nearest * kReflectionBias;
        if (!isBefore && level == 0 && min(atBegin, atEnd) <= nearest + thickness) {
            found = meetsDistance(ray, begin, end, nearest);
            break;
        }
        if (isBefore || level == 0) {
            begin = end;
            atBegin = atEnd;
        }
        level = isBefore ? min(level + 1, last) : max(level - 1, 0);
    }
    return found;
}

// The scene colour at the hit, and its part of the reflection. `share`: of the ray, [0, 1].
PictureHit lookAtHit(highp vec3 direction, highp float meters, highp float share, highp float perceptualRoughness) {
    highp vec4 place = frameUniforms.clipFromWorld * vec4(vertex_worldPosition + direction * meters, 1.0);
    highp vec2 uv = place.xy / max(place.w, 1e-30) * 0.5 + 0.5;
    highp float pixelsPerMeter = 0.5 * passUniforms.target.y * abs(frameUniforms.clipFromView[1].y) / max(place.w, 1e-30);
    highp float radius = lobeRadius(perceptualRoughness * perceptualRoughness) * meters * pixelsPerMeter;
    highp vec2 pixel = uv * passUniforms.target.xy;
    highp vec4 texel = pictureTexel(pixel, min(blurLevel(radius), passUniforms.raster.z));
    // Where it showed another surface, the hit was hidden.
    highp float known = smoothUnit(3.0 - 30.0 * abs(pictureTexel(pixel, 0.0).a * place.w - 1.0));
    highp vec2 inPicture = (pixel - passUniforms.picture.xy) / (passUniforms.picture.zw - passUniforms.picture.xy);
    highp float weight = known * insideWeight(uv, kReflectionBorder) * insideWeight(inPicture, kReflectionBorder);
    return PictureHit(texel.rgb, place.w > 0.0 ? weight * reachWeight(share) : 0.0, meters);
}

PictureHit reflectionInPicture(highp vec3 direction, highp float perceptualRoughness) {
    PictureHit hit = noHit();
    highp float away = awayWeight(dot(direction, shading_view));
    if (away > 0.0) {
        highp float meters = passUniforms.reflection.y;
        PictureRay ray = pictureRay(vertex_worldPosition, direction, meters);
        highp float s = hitOfRay(ray);
        if (s >= 0.0) {
            // From a fraction of the line to a fraction of the ray.
            meters *= s * ray.w.y / (ray.w.x + (ray.w.y - ray.w.x) * s);
            hit = lookAtHit(direction, meters, meters / passUniforms.reflection.y, perceptualRoughness);
            hit.weight *= away;
        }
    }
    return hit;
}
