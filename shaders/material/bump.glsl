// SPDX-License-Identifier: Apache-2.0
// Bump maps: the red channel is a height over the surface, in metres of world space once it has been multiplied by a
// factor. Displaced along its normal n by the height h, a surface has the normal n - grad h, where grad h is the
// surface gradient. With the derivatives r and d of the position towards the pixels to the right and below
//     grad h = (h_r cross(d, n) + h_d cross(n, r)) / dot(r, cross(d, n))
// Mikkelsen, "Bump Mapping Unparametrized Surfaces on the GPU" (2010), equations 3 and 4. It needs no tangents, and the
// gradients of several maps add up: Mikkelsen, "Surface Gradient-Based Bump Mapping Framework", JCGT 9(3), 2020.

float largestOf(vec3 v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); }

float bumpHeight(sampler2D heights, vec2 uv) { return texture(heights, uv).r; }

// By how many metres the height grows towards the next pixels: that of a surface whose heights are means over a texel,
// or over a pixel where pixels are larger. (The difference over a width is the derivative of the mean over that width.)
// So its slope is continuous where texels are magnified, while that of a filtered texture is constant in each texel.
vec2 bumpRise(sampler2D heights, vec2 uv, float metres) {
    vec2 right = dFdx(uv), down = dFdy(uv);
    vec2 width = max(max(abs(right), abs(down)), 1.0 / vec2(textureSize(heights, 0)));
    vec2 toU = vec2(0.5 * width.x, 0.0), toV = vec2(0.0, 0.5 * width.y);
    vec2 growth = vec2(bumpHeight(heights, uv + toU) - bumpHeight(heights, uv - toU),
            bumpHeight(heights, uv + toV) - bumpHeight(heights, uv - toV));
    vec2 rise = vec2(dot(growth, right / width), dot(growth, down / width)) * metres;
    // |rise| <= 2 |metres|, unless coordinates overflow: then there is no bump, and no NaN.
    float limit = 2.5 * abs(metres);
    return abs(rise.x) <= limit && abs(rise.y) <= limit ? rise : vec2(0.0);
}

#if defined(HAS_NORMAL) && defined(NEEDS_NORMAL) && defined(NEEDS_WORLD_POSITION)
// Tilts `normal`, unit and perhaps of a normal map, against the surface gradient of the heights. Unchanged, to the bit,
// where the height is even, and where the triangle is too small to tell.
vec3 bumpedNormal(vec3 normal, bool isMapped, vec2 rise) {
    const float kSmallest = 1e-30; // metres
    vec3 right = dFdx(vertex_worldPosition), down = dFdy(vertex_worldPosition);
    float width = largestOf(right), height = largestOf(down);
    if (width < kSmallest || height < kSmallest || rise == vec2(0.0)) return normal;
    right /= width;
    down /= height;
    vec3 n = shading_geometricNormal;
    vec3 acrossDown = cross(down, n), acrossRight = cross(n, right);
    float area = dot(right, acrossDown);
    if (area == 0.0) return normal;
    vec3 gradient = acrossDown * (rise.x / width) + acrossRight * (rise.y / height); // times area
    if ((area < 0.0) != !gl_FrontFacing) gradient = -gradient; // seen from behind
    // The gradient of a normal map is n - normal / dot(n, normal).
    float upright = isMapped ? max(dot(n, normal), 0.0) : 1.0;
    vec3 bumped = normal * abs(area) - gradient * upright;
    return normalizeOrZero(bumped / max(largestOf(bumped), kSmallest));
}

void tiltTo(vec3 bumped) {
    shading_isBumped = shading_isBumped || bumped != shading_normal;
    shading_normal = bumped;
    shading_NoV = max(dot(shading_normal, shading_view), kMinNoV);
    shading_reflected = reflect(-shading_view, shading_normal);
}

void applyBump(sampler2D heights, vec2 uv, float metres) {
    tiltTo(bumpedNormal(shading_normal, shading_isBumped, bumpRise(heights, uv, metres)));
}
#else
void applyBump(sampler2D heights, vec2 uv, float metres) {} // where no normal counts, as in a shadow map
#endif
