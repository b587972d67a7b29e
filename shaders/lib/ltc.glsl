// SPDX-License-Identifier: Apache-2.0
// Light from areas of equal luminance: the integral of a cosine over a polygon, and the linear transformation that makes
// such a cosine of a specular lobe. Heitz, Dupuy, Hill and Neubelt 2016, "Real-Time Polygonal-Light Shading with Linearly
// Transformed Cosines".
//   Space     that of a surface: z is the normal, x and z are in the plane of normal and view, and the view is at x >= 0.
//   Polygon   center + corner.x halfX + corner.y halfY, where the corner is turned from one to the next. It faces the
//             surface if cross(halfX, halfY) points away from it.
//   fp32 only.

// Of the table of transformations: values a side.
const int kLtcTableSize = 32;
const float kLtcMinRoughness = 0.045f; // kMinPerceptualRoughness: of the first row

// Polygons smaller than this, as squared half extent over squared distance, are points: their edges would cancel.
const float kPointLikeExtent = 1.52587890625e-5f; // 2^-16

// The angle whose cosine is x, over its sine: a polynomial on [0, 1], with errors below 1e-6. It has no pole at 1.
float angleOverSine(float x) {
    float high = 0.5115087f + x * (-0.32747102f + x * (0.13848963f - x * 0.027354034f));
    return 1.57079566f + x * (-0.99991328f + x * (0.7834481f + x * (-0.64950423f + x * high)));
}

// What the edge from a to b adds to twice the integral of the direction over a polygon: the angle between them along
// their normal. Lambert 1760; Baum, Rushmeier and Winget 1989, "Improving Radiosity Solutions through the Use of
// Analytically Determined Form-Factors". Any length, also 0, which adds nothing.
// The difference in the cross product keeps the digits of short edges.
vec3 edgeIntegral(vec3 a, vec3 b) {
    vec3 from = a * (1.0f / sqrt(max(dot(a, a), 1e-30f)));
    vec3 to = b * (1.0f / sqrt(max(dot(b, b), 1e-30f)));
    vec3 normal = cross(from, to - from);
    float cosine = clamp(dot(from, to), -1.0f, 1.0f);
    float near = angleOverSine(max(cosine, -cosine));
    float far = kPi / sqrt(max(dot(normal, normal), 1e-14f)) - near; // beyond a right angle
    return normal * (cosine < 0.0f ? far : near);
}

// Where the line from a to b, which are on different sides of the horizon, crosses it.
vec3 horizonBetween(vec3 a, vec3 b) {
    float part = a.z / (a.z - b.z);
    return vec3(a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part, 0.0f);
}

// The integral of the direction over the part of a small polygon's solid angle: that of a point. area: of the polygon
// over the area of halfX and halfY.
vec3 pointIntegral(vec3 center, vec3 halfX, vec3 halfY, float area) {
    float square = max(dot(center, center), 1e-30f);
    float facing = dot(center, cross(halfX, halfY)) * area / square;
    return center.z > 0.0f ? center * (facing / square) : vec3(0.0f);
}

// The integral of the direction over the solid angle of the part of a polygon above the horizon: z is the irradiance at a
// luminance of 1, in [-pi, pi], negative for a polygon that faces away. Every edge is cut at the horizon; where the
// polygon leaves and enters, one more edge along the horizon closes it.
// corner: the last one; turn: cosine and sine from one to the next.
vec3 polygonIntegral(vec3 center, vec3 halfX, vec3 halfY, vec2 corner, vec2 turn, int corners) {
    vec3 first = center + halfX * corner.x + halfY * corner.y;
    vec3 from = first;
    vec3 leaves = vec3(0.0f);
    vec3 enters = vec3(0.0f);
    vec3 sum = vec3(0.0f);
    for (int i = 1; i <= corners; ++i) {
        corner = vec2(corner.x * turn.x - corner.y * turn.y, corner.x * turn.y + corner.y * turn.x);
        vec3 to = center + halfX * corner.x + halfY * corner.y;
        if (i == corners) to = first;
        if (from.z > 0.0f || to.z > 0.0f) {
            vec3 begin = from;
            vec3 end = to;
            if (from.z < 0.0f) {
                begin = horizonBetween(from, to);
                enters = begin;
            }
            if (to.z < 0.0f) {
                end = horizonBetween(from, to);
                leaves = end;
            }
            sum = sum + edgeIntegral(begin, end);
        }
        from = to;
    }
    return (sum + edgeIntegral(leaves, enters)) * 0.5f;
}

// Corners of a rectangle of half edges halfX and halfY.
const int kRectCorners = 4;
// A disc of radii halfX and halfY is this polygon, which has its area: the corners lie 1.3 % outside.
const int kDiscCorners = 16;
const float kDiscCorner = 1.01295057f; // sqrt(2 pi / (16 sin(2 pi / 16)))

// The integral over a rectangle or a disc of any size and at any distance, 0 if it has no extent.
vec3 areaIntegral(vec3 center, vec3 halfX, vec3 halfY, bool isDisc) {
    vec3 largest = max(max(max(center, -center), max(halfX, -halfX)), max(halfY, -halfY));
    float scale = 1.0f / max(max(largest.x, max(largest.y, largest.z)), 1e-30f);
    vec3 c = center * scale;
    vec3 x = halfX * scale;
    vec3 y = halfY * scale;
    vec3 result = vec3(0.0f);
    if (dot(x, x) + dot(y, y) < kPointLikeExtent * dot(c, c)) {
        result = pointIntegral(c, x, y, isDisc ? kPi : 4.0f);
    } else {
        vec2 corner = isDisc ? vec2(kDiscCorner, 0.0f) : vec2(1.0f, 1.0f);
        vec2 turn = isDisc ? vec2(0.923879533f, 0.382683432f) : vec2(0.0f, 1.0f); // 22.5 and 90 degrees
        result = polygonIntegral(c, x, y, corner, turn, isDisc ? kDiscCorners : kRectCorners);
    }
    return result;
}

// ---- the specular lobe

// Where the table has the transformation of a lobe: column and row, in [0, kLtcTableSize - 1]. nov in [0, 1].
vec2 ltcCoordinates(float nov, float perceptualRoughness) {
    float row = (perceptualRoughness - kLtcMinRoughness) / (1.0f - kLtcMinRoughness);
    return vec2(sqrt(saturate(1.0f - nov)), saturate(row)) * float(kLtcTableSize - 1);
}

// A transformation that maps the lobe of a surface to a cosine is (x, y, z) -> (a x + b z, y, d z): it keeps the horizon,
// so that nothing below it shines and a polygon is cut only once. Of a mirror, a is nov^2, b nov sin, and d 2 alpha; the
// table holds what the others differ by: entry = (a - nov^2, b - nov sin, d / (2 alpha)).
// Returns (a, b, d).
vec3 ltcTransformation(vec3 entry, float nov, float alpha) {
    float sine = sqrt(saturate(1.0f - nov * nov));
    return vec3(nov * nov + entry.x, nov * sine + entry.y, 2.0f * alpha * entry.z);
}

vec3 ltcApply(vec3 transformation, vec3 v) {
    return vec3(transformation.x * v.x + transformation.y * v.z, v.y, transformation.z * v.z);
}

// The transformed cosine in a direction: its integral over the hemisphere is 1. Eq. 1 and 4. direction: unit.
float ltcLobe(vec3 transformation, vec3 direction) {
    vec3 v = ltcApply(transformation, direction);
    float square = dot(v, v);
    float area = transformation.x * transformation.z / (square * square); // determinant over |v|^4
    return max(v.z, 0.0f) * area * kInversePi;
}
