// SPDX-License-Identifier: Apache-2.0
// Fog on the colour of a fragment, by its blending. quality_fog is a set of shader::FogTerms.

const int kFogFromEnvironment = 2;
const int kFogFromRgbm = 4;
const int kFogSun = 8;
const int kFogScattering = 16;
const int kFogCells = 32;
const int kFogVaries = kFogCells | kFogSun;

// Lit materials have their position. Others need it only here, and derive it from the depth, or from its
// inverse as it was before the projection, which is as exact with any depth range.
FogRay fogRayOfFragment() {
#if defined(FOG_POINT_IS_KNOWN)
    highp vec4 point = vec4(vertex_worldPosition, 1.0);
#else
    highp vec4 point = fogPointAt(gl_FragCoord.xy, gl_FragCoord.z);
#if !defined(VERTEX_DOMAIN_DEVICE)
    point.w = gl_FragCoord.w;
#endif
#endif
    return fogRayTo(point);
}

// Of what is all fog.
highp vec3 fogRadiance(highp vec3 direction) {
    highp vec3 light = frameUniforms.fogLight.rgb;
    if ((quality_fog & kFogFromEnvironment) != 0) {
        highp vec3 inEnvironment = direction * mat3(frameUniforms.worldFromEnvironment);
        highp vec4 texel = textureLod(passFog, inEnvironment, frameUniforms.ambient.y);
        if ((quality_fog & kFogFromRgbm) != 0) {
            light *= radianceFromRgbm(texel);
        } else {
            light *= texel.rgb;
        }
    }
    return light;
}

highp vec4 fogBorder(int border) {
    uvec2 halves = fogCells.borders[border];
    return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y));
}

// The light in the fog before the fragment that lamps and the sun send, as the dispatch has summed it up to the borders
// of slices; w: the opacity up to where it was. Within a slice light grows with opacity, so it is exact where nothing but
// the fog changes. If the density varies, the opacity is that of the cells: even fog within a slice.
highp vec4 lightOfFogCells(FogRay ray, highp float opacity) {
    highp vec4 grid = frameUniforms.fogGrid;
    highp float slice = fogSliceAt(ray.meters * dot(ray.direction, fogForward()), grid.z, grid.w);
    highp float nearest = min(floor(slice), grid.z - 1.0);
    highp vec2 at = clamp(gl_FragCoord.xy * passUniforms.target.zw * grid.xy - 0.5, vec2(0.0), grid.xy - 1.0);
    highp vec2 corner = floor(at);
    highp vec2 part = at - corner;
    highp vec4 before = vec4(0.0), behind = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        highp vec2 step = vec2(float(i & 1), float(i >> 1));
        highp vec2 cell = min(corner + step, grid.xy - 1.0);
        highp vec2 shares = vec2(1.0) - abs(part - step);
        int border = int((cell.y * grid.x + cell.x) * (grid.z + 1.0) + nearest);
        before += fogBorder(border) * (shares.x * shares.y);
        behind += fogBorder(border + 1) * (shares.x * shares.y);
    }
    if ((quality_fog & kFogVaries) == kFogVaries) {
        highp float part = min((slice - nearest) * (slice + nearest) / (2.0 * nearest + 1.0), 1.0);
        opacity = 1.0 - (1.0 - before.w) * pow((1.0 - behind.w) / max(1.0 - before.w, 1e-6), part);
    }
    highp float inside = clamp((opacity - before.w) / max(behind.w - before.w, 1e-6), 0.0, 1.0);
    return vec4(mix(before.rgb, behind.rgb, inside), min(behind.w, opacity));
}

// The light of lamps and of the sun in the fog before the fragment. cells: lightOfFogCells().
highp vec3 scatteredLight(FogRay ray, highp vec4 cells, highp float opacity) {
    highp vec4 sun = frameUniforms.fogSun;
    highp float phase = henyeyGreenstein(dot(ray.direction, frameUniforms.fogSunDirection.xyz), frameUniforms.fogScattering.w);
    cells.rgb += sun.rgb * (phase * (opacity - cells.w) * sun.w); // beyond the grid the sun has no shadows
    return ray.meters > frameUniforms.fogMedium.w ? vec3(0.0) : cells.rgb;
}

// The light of the fog between camera and fragment; w: its opacity.
highp vec4 fogOfFragment() {
    FogRay ray = fogRayOfFragment();
    highp vec4 sun = frameUniforms.fogSunDirection;
    bool isGlowing = (quality_fog & kFogVaries) == kFogSun, varies = (quality_fog & kFogVaries) == kFogVaries;
    highp float opacity = 0.0, glowing = 0.0, from = sun.w; // a loop, because the code of the integral is long
    for (int i = isGlowing ? 0 : 1; i < 2; ++i) {
        glowing = opacity;
        if (i == 1) from = frameUniforms.fogMedium.z;
        if (varies) from = max(from, frameUniforms.fogGrid.w / dot(ray.direction, fogForward())); // behind the cells
        opacity = fogAlong(ray, from);
    }
    highp vec4 cells = vec4(0.0);
    if ((quality_fog & kFogCells) != 0) cells = lightOfFogCells(ray, opacity);
    if (varies) opacity = ray.meters > frameUniforms.fogMedium.w ? 0.0 : min(cells.w + (1.0 - cells.w) * opacity, frameUniforms.fogLight.w);
    highp vec3 light = fogRadiance(ray.direction) * opacity;
    if (isGlowing) {
        highp float glow = fogGlow(dot(ray.direction, sun.xyz), frameUniforms.fogSun.w);
        light += frameUniforms.fogSun.rgb * (glow * glowing);
    }
    if ((quality_fog & kFogScattering) != 0) light += scatteredLight(ray, cells, opacity);
    return vec4(light, opacity);
}

// FOG_COVERS: alpha is how much of the pixel the surface covers, and the colour contains it. FOG_ADDS: the surface adds
// to what is behind, which has fog of its own. FOG_FILTERS: it multiplies what is behind, and fog in front hides the
// filter. seen: scene colour behind, in the colour, which has its fog already; share: how much of the surface
// shows it.
void applyFog(inout highp vec4 color, highp vec3 seen, highp vec3 share) {
    highp vec4 fog = fogOfFragment();
    highp float left = 1.0 - fog.w;
#if defined(FOG_FILTERS)
    color = color * left + fog.w;
#elif defined(FOG_ADDS)
    color.rgb *= left;
#elif defined(FOG_COVERS)
    color.rgb = (color.rgb - seen) * left + fog.rgb * (vec3(1.0) - share) * color.a + seen;
#else
    color.rgb = (color.rgb - seen) * left + fog.rgb * (vec3(1.0) - share) + seen;
#endif
}
