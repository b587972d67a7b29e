// SPDX-License-Identifier: Apache-2.0
// Screen-space ambient occlusion: points and planes behind pixels, occlusion of one sample, and what lies
// between two horizons, and how an occlusion texture holds it. Points are in view space: the camera is the origin and
// looks down -z.
//   Ray     of a pixel: the point of its distance d along the view is (d ray, -d)
//   Lean    how far the mean open direction leans from the normal: (unit open direction) - normal
// docs/ambient-occlusion.md derives the formulas that are our own.

// The share of the cosine-weighted hemisphere that one sample hides is the square of its elevation's sine; this many
// times the mean of the samples is what the highest of a direction hides. Chosen beside traced rays of edges.
const float kSpiralGain = 3.0f;

// 1 / distance is linear in the pixels of a plane. `inward`, `outward`: at the nearer and the farther one of two pixels
// to one side; returns by how much the line through them misses `here`. All 1 / metres, >= 0.
float missOfLine(float here, float inward, float outward) { return abs(2.0f * inward - outward - here); }

// The unit normal of a plane, towards the camera. slope: of 1 / distance over the plane's rays, along x and y; ray and
// inverse (1 / metres, >= 0): of the point. On the plane, n.xy . ray - n.z is proportional to 1 / distance. fp32 only.
vec3 normalOfPlane(vec2 slope, vec2 ray, float inverse) {
    vec3 n = vec3(-slope.x, -slope.y, inverse - slope.x * ray.x - slope.y * ray.y);
    float largest = max(max(abs(n.x), abs(n.y)), abs(n.z));
    if (!(largest > 1e-36f)) return vec3(0.0f, 0.0f, 1.0f);
    n = n / largest;
    return n * inversesqrt(dot(n, n));
}

// What a point hides whose offset from the shaded one is `offset`, over the radius, and rises `height` above the
// surface there, over the radius: sine^2 of its elevation, down to nothing at the radius. McGuire, Mara and Luebke
// 2012, "Scalable Ambient Obscurance", eq. 2 is of this kind; ours has no unit of its own, so 16 bits suffice. Returns
// [0, 1].
float hiddenBySample(vec3 offset, float height) {
    float squared = dot(offset, offset);
    float above = max(height, 0.0f);
    float fade = saturate(4.0f - 4.0f * squared);
    return min(above * above / max(squared, 1e-4f), 1.0f) * fade;
}

// The arc cosine to 7e-5. Abramowitz and Stegun 1964, 4.4.45, mirrored. x: [-1, 1]. Returns [0, pi].
float arcCosine(float x) {
    float a = min(abs(x), 1.0f);
    float positive = sqrt(1.0f - a) * (1.5707288f + a * (-0.2121144f + a * (0.0742610f - 0.0187293f * a)));
    return x < 0.0f ? kPi - positive : positive;
}

// The cosine-weighted part of a half slice from the view up to its horizon: the integral of sin t cos(t - n) for t from
// 0 to h; Jimenez et al. 2016, "Practical Realtime Strategies for Accurate Indirect Occlusion", eq. 7, in other terms.
// cosine: of h, the angle between view and horizon, [-1, 1]. normal: cosine and sine of n, the angle between the view
// and the projected normal, which is positive towards this half. Returns [0, 2].
float openOfHalfSlice(float cosine, vec2 normal) {
    float sine = sqrt(max(1.0f - cosine * cosine, 0.0f));
    return 0.5f * (normal.x * sine * sine + normal.y * (arcCosine(cosine) - sine * cosine));
}

// The integral of the directions of the same half slice, with the same weight: x towards this half, y towards the view.
vec2 directionOfHalfSlice(float cosine, vec2 normal) {
    float square = max(1.0f - cosine * cosine, 0.0f);
    float sines = square * sqrt(square) * (1.0f / 3.0f);
    float cosines = cosine * cosine * cosine * (1.0f / 3.0f);
    return vec2(normal.x * sines + normal.y * (2.0f / 3.0f - cosine + cosines),
            normal.x * (1.0f / 3.0f - cosines) + normal.y * sines);
}

// The mean direction of what a sample hides, times 3/2 of its weight: the cosine-weighted wedge from the surface up to
// the sample, whose sine of the elevation is `sine`. x: along the surface towards the sample, y: along the normal. [0,
// 1] -> [0, 3/2].
vec2 directionOfWedge(float sine) {
    float cosine = sqrt(max(1.0f - sine * sine, 0.0f));
    return vec2((1.0f + cosine * (1.0f + cosine)) / (1.0f + cosine), sine);
}

// Texels of an occlusion texture with 8 bits a channel hold leans as multiples of 1/127, so that 0 is exact.
vec3 encodeLean(vec3 lean) { return (clamp(lean, -1.0f, 1.0f) * 127.0f + 128.0f) * (1.0f / 255.0f); }
vec3 decodeLean(vec3 texel) { return (texel * 255.0f - 128.0f) * (1.0f / 127.0f); }

// The weight of a neighbour whose 1 / distance is `inverse` where its plane would have `expected`: 1 on the plane, 0
// from `tolerance` on. All 1 / metres; tolerance > 0. Returns [0, 1]. fp32 only: inverse distances may be small.
float weightOfNeighbor(float inverse, float expected, float tolerance) {
    return saturate(1.0f - abs(inverse - expected) / tolerance);
}
