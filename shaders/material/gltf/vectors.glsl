// SPDX-License-Identifier: Apache-2.0
// Vectors that textures hold, in the frame of the vertices. A texture's x points along its u and its y against its v,
// whatever its texture coordinates are; the tangents of a primitive follow those of one map (assets::TangentBasis). The
// specification of KHR_texture_transform says nothing of vectors: here they turn with the texture, so that a transform
// draws what a mesh draws whose texture coordinates contain it.

// The values of assets::MapFrame; 0: the frame of the vertices.
const int kFrameTurned = 1;
const int kFrameDerived = 2;

highp vec2 leftOf(highp vec2 v) { return vec2(-v.y, v.x); }
highp vec2 unit(highp vec2 v) { return normalizeOrZero(vec3(v, 0.0)).xy; }

// uv' = A uv with det(A) = `area`: along +u' the vertices' (u, -v) change by inverse(A) (1, 0).
highp vec2 turnedVector(highp vec2 v, highp mat3 transform) {
    highp float area = transform[0].x * transform[1].y - transform[1].x * transform[0].y;
    if (area == 0.0) return v;
    highp vec2 right = unit(vec2(transform[1].y, transform[0].y) * sign(area));
    return v.x * right + v.y * sign(area) * leftOf(right);
}

// Of other texture coordinates than the tangents follow: from the derivatives of both over the screen, as in Schueler,
// "Normal Mapping without Precomputed Tangents" (ShaderX 5, 2006).
highp vec2 derivedVector(highp vec2 v, highp vec2 uv) {
#if defined(NEEDS_NORMAL) && defined(NEEDS_WORLD_POSITION)
    highp vec3 across = dFdx(vertex_worldPosition), down = dFdy(vertex_worldPosition);
    highp vec2 uvAcross = dFdx(uv), uvDown = dFdy(uv);
    highp float area = uvAcross.x * uvDown.y - uvDown.x * uvAcross.y;
    highp mat3 frame = getWorldTangentFrame();
    // The frame of a back face is reversed as a whole, and so are both vectors.
    highp float side = dot(frame[2], vertex_worldNormal) < 0.0 ? -sign(area) : sign(area);
    highp vec3 alongU = (across * uvDown.y - down * uvAcross.y) * side;
    highp vec3 againstV = (across * uvDown.x - down * uvAcross.x) * side;
    highp vec2 right = unit(vec2(dot(alongU, frame[0]), dot(alongU, frame[1])));
    highp vec2 up = vec2(dot(againstV, frame[0]), dot(againstV, frame[1]));
    if (area == 0.0 || right == vec2(0.0)) return v;
    return v.x * right + v.y * (dot(leftOf(right), up) < 0.0 ? -1.0 : 1.0) * leftOf(right);
#else
    return v; // nothing is lit
#endif
}

highp vec2 vectorOfVertex(highp vec2 v, int frame, highp vec2 uv, highp mat3 transform) {
    if (frame == kFrameTurned) return turnedVector(v, transform);
    return frame == kFrameDerived ? derivedVector(v, uv) : v;
}
