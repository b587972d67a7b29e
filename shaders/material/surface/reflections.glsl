// SPDX-License-Identifier: Apache-2.0
// Reflections of the picture, for lit materials with `reflections : screenspace`: the mirrored ray is followed through
// the distances of what is opaque, pixel by pixel in steps that grow away from the surface. What it hits has the colour
// that the picture shows there: for opaque surfaces the last frame's picture, at the place where the hit was then.
//   After   McGuire and Mara 2014, "Efficient GPU Screen-Space Ray Tracing": lines of the picture are walked, and what
//           is linear in the world is interpolated as a fraction of w.

const highp float kReflectionBorder = 0.08;     // of the picture, over which hits fade
const highp float kReflectionBias = 0.0009765625; // of the distance: what counts as the same surface
const int kReflectionBisections = 6;

#include "shaders/material/surface/picture_texel.glsl"

struct PictureHit {
    highp vec3 color; // pre-exposed
    highp float weight; // [0, 1]: how much of the reflection it is; the environment is the rest
    highp float meters; // along the ray
};

PictureHit noHit() { return PictureHit(vec3(0.0), 0.0, 0.0); }

// For DebugView::Reflections: red is -1 - metres, or -0.5 where nothing is hit.
highp vec3 codeOfHit(PictureHit hit) { return vec3(hit.weight > 0.0 ? -1.0 - min(hit.meters, 6e4) : -0.5, 0.0, 0.0); }

// A ray as a line of the picture.
struct PictureRay {
    highp vec2 start, along; // pixels: along: to where it ends
    highp vec2 w;            // 1 / w at both ends
    highp vec2 distances;    // along the view, over w
    highp float end;         // of the line that lies in the picture, [0, 1]
};

highp vec2 pixelOfClip(highp vec4 clip) { return (clip.xy / clip.w * 0.5 + 0.5) * passUniforms.target.xy; }

// The part of [0, 1] on which start + along s lies within [0, size].
highp float insidePicture(highp float start, highp float along, highp float size) {
    highp float bound = along > 0.0 ? size : 0.0;
    highp float end = abs(along) > 1e-6 ? (bound - start) / along : 1.0;
    return clamp(end, 0.0, 1.0);
}

// `meters`: how far the ray goes; less, where it would pass behind the camera.
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

highp float distanceOfPicture(PictureRay ray, highp float s) {
    highp vec2 pixel = clamp(floor(ray.start + ray.along * s), vec2(0.0), passUniforms.target.xy - 1.0);
    return texelFetch(passSceneDepth, ivec2(pixel), 0).x;
}

// Where on the line the ray goes behind a surface; below 0: nowhere.
highp float hitOfRay(PictureRay ray) {
    int steps = int(passUniforms.reflection.x);
    highp float thickness = passUniforms.reflection.z;
    highp float onePixel = 1.0 / max(max(abs(ray.along.x), abs(ray.along.y)), 1e-6);
    highp float before = onePixel, found = -1.0;
    highp float distanceBefore = distanceOfRay(ray, before);
    for (int i = 1; i <= steps; ++i) {
        highp float u = float(i) / passUniforms.reflection.x;
        highp float s = max(ray.end * u * u, onePixel * (float(i) + 1.0)); // its own pixel is the surface itself
        if (s > ray.end) break;
        highp float distance = distanceOfRay(ray, s);
        highp float surface = distanceOfPicture(ray, s);
        bool isBehind = distance > surface + surface * kReflectionBias;
        if (isBehind && min(distance, distanceBefore) <= surface + thickness) {
            found = s;
            break;
        }
        before = s;
        distanceBefore = distance;
    }
    if (found >= 0.0) {
        for (int i = 0; i < kReflectionBisections; ++i) {
            highp float middle = (before + found) * 0.5;
            highp float surface = distanceOfPicture(ray, middle);
            if (distanceOfRay(ray, middle) > surface + surface * kReflectionBias) {
                found = middle;
            } else {
                before = middle;
            }
        }
        if (distanceOfRay(ray, found) > distanceOfPicture(ray, found) + thickness) found = -1.0; // beside an edge
    }
    return found;
}

// What the picture has where it showed the hit, and how much of the reflection that is. `share`: of the ray, [0, 1].
PictureHit lookAtHit(highp vec3 direction, highp float meters, highp float share, highp float perceptualRoughness) {
    highp vec4 place = passUniforms.pictureFromWorld * vec4(vertex_worldPosition + direction * meters, 1.0);
    highp vec2 uv = place.xy / max(place.w, 1e-30) * 0.5 + 0.5;
    highp float pixelsPerMeter = 0.5 * passUniforms.target.y * abs(frameUniforms.clipFromView[1].y) / max(place.w, 1e-30);
    highp float radius = lobeRadius(perceptualRoughness * perceptualRoughness) * meters * pixelsPerMeter;
    highp vec2 pixel = uv * passUniforms.target.xy;
    highp vec4 texel = pictureTexel(pixel, min(blurLevel(radius), passUniforms.raster.z));
    // Where it showed something else, the hit was hidden then.
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
            // From a share of the line to one of the ray.
            meters *= s * ray.w.y / (ray.w.x + (ray.w.y - ray.w.x) * s);
            hit = lookAtHit(direction, meters, meters / passUniforms.reflection.y, perceptualRoughness);
            hit.weight *= away;
        }
    }
    return hit;
}
