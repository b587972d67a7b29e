// SPDX-License-Identifier: Apache-2.0
// Areas on the standard model and specular-glossiness: the diffuse lobe by the integral of the cosine, the specular lobes
// by linearly transformed cosines. What depends on the direction of light otherwise (the diffuse lobe's share, sheen, the
// boundary of bumps) uses the mean direction.

// The entry of the table between its nodes.
highp vec3 ltcNode(int column, int row) {
    int word = int(frameUniforms.froxelPlaces.w) + 3 * (row * kLtcTableSize + column);
    return vec3(uintBitsToFloat(froxelBuffer.words[word]), uintBitsToFloat(froxelBuffer.words[word + 1]),
            uintBitsToFloat(froxelBuffer.words[word + 2]));
}

highp vec3 ltcOf(highp float nov, highp float perceptualRoughness, highp float alpha) {
    highp vec2 at = ltcCoordinates(nov, perceptualRoughness);
    int column = min(int(at.x), kLtcTableSize - 2);
    int row = min(int(at.y), kLtcTableSize - 2);
    highp float right = at.x - float(column);
    highp float below = at.y - float(row);
    highp vec3 upper = mix(ltcNode(column, row), ltcNode(column + 1, row), right);
    highp vec3 lower = mix(ltcNode(column, row + 1), ltcNode(column + 1, row + 1), right);
    return ltcTransformation(mix(upper, lower, below), nov, alpha);
}

// The share of a lobe that the light fills, [0, 1].
highp float lobeShare(AreaFrame frame, AreaLight area, highp vec3 ltc) {
    return shiningIntegral(area, ltcApply(ltc, inFrame(frame, area.center)), ltcApply(ltc, inFrame(frame, area.halfX)),
                   ltcApply(ltc, inFrame(frame, area.halfY))).z * kInversePi;
}

#if defined(HAS_ANISOTROPY)

// Transformed, x and y are slopes of facets over alpha, so that a stretched lobe is another scale along the grain.
// turn: cosine and sine from the frame's x to the tangent. scale: alpha over that of the grain.
highp vec3 ltcApplyGrain(highp vec3 v, highp vec2 turn, highp vec2 scale) {
    return vec3((v.x * turn.x + v.y * turn.y) * scale.x, (v.y * turn.x - v.x * turn.y) * scale.y, v.z);
}

highp float groovesShare(Surface surface, AreaFrame frame, AreaLight area, highp vec3 ltc) {
    highp vec2 turn = vec2(dot(surface.grooves.tangent, frame.x), dot(surface.grooves.tangent, frame.y));
    highp float length = sqrt(dot(turn, turn));
    turn = length > 0.5 ? turn / length : vec2(1.0, 0.0); // the geometry may have no tangents
    highp vec2 grain = surface.grooves.alpha;
    highp vec2 scale = vec2(surface.alpha) / grain;
    highp vec3 center = ltcApplyGrain(ltcApply(ltc, inFrame(frame, area.center)), turn, scale);
    highp vec3 halfX = ltcApplyGrain(ltcApply(ltc, inFrame(frame, area.halfX)), turn, scale);
    highp vec3 halfY = ltcApplyGrain(ltcApply(ltc, inFrame(frame, area.halfY)), turn, scale);
    return shiningIntegral(area, center, halfX, halfY).z * kInversePi;
}

#endif

// All of the specular lobe of the base that the light fills, before its luminance.
highp vec3 specularOfArea(Surface surface, AreaFrame frame, AreaLight area) {
    highp vec3 ltc = ltcOf(surface.nov, surface.perceptualRoughness, surface.alpha);
    highp float share;
#if defined(HAS_ANISOTROPY)
    if (surface.grooves.amount != 0.0) {
        share = groovesShare(surface, frame, area, ltc);
    } else
#endif
    {
        share = lobeShare(frame, area, ltc);
    }
    return surface.specularAlbedo * share;
}

#if defined(HAS_DIFFUSE_TRANSMISSION) || defined(REFRACTION_THIN)

highp vec3 areaFromBehind(Surface surface, AreaFrame frame, AreaLight area) {
    AreaFrame behind = behindOf(frame);
    highp vec3 integral = integralOver(behind, area);
    highp vec3 crossed = vec3(0.0);
    if (integral.z > 0.0) {
        Light arriving = representativeOf(behind, area, integral);
#if defined(HAS_DIFFUSE_TRANSMISSION)
        float cosine = saturate(-dot(surface.normal, arriving.direction));
        vec3 left = diffuseLeft(surface, arriving.direction, cosine);
        crossed = area.luminance * (surface.transmitted * left * (diffuseLambert() * integral.z)) * area.color;
#if defined(HAS_SHEEN)
        crossed *= sheenLeaves(surface.sheen);
#endif
#endif
#if defined(REFRACTION_THIN)
        if (surface.refraction.transmission > 0.0) {
            crossed += surface.through *
                    lightThrough(surface.refraction, surface.normal, surface.view, surface.nov, arriving);
        }
#endif
    }
    return crossed;
}

#endif

#if defined(HAS_CLEAR_COAT)

highp vec3 addCoatOfArea(Surface surface, AreaLight area, vec3 direction, highp vec3 below) {
    Coat coat = surface.coat;
    float cosine = dot(coat.normal, direction);
    highp vec3 reflected = below * coatLeavesOfLight(coat, max(cosine, -cosine));
    highp vec3 ltc = ltcOf(coat.nov, coat.perceptualRoughness, coat.alpha);
    highp float share = lobeShare(areaFrame(coat.normal, surface.view), area, ltc);
    vec3 specular = vec3(coatAlbedo(coat));
#if defined(HAS_CLEAR_COAT_NORMAL)
    specular = aboveHorizon(specular, true, direction);
#endif
    return reflected + area.luminance * area.mirrored * (specular * share);
}

#endif

highp vec3 shadeAreaByLtc(Surface surface, AreaLight area) {
    AreaFrame frame = areaFrame(surface.normal, surface.view);
    highp vec3 integral = integralOver(frame, area);
    vec3 direction = representativeOf(frame, area, integral).direction;
    highp vec3 reflected = vec3(0.0);
    if (integral.z > 0.0) {
        float nol = saturate(dot(surface.normal, direction));
        vec3 halfway = normalizeOrZero(surface.view + direction);
        float voh = saturate(dot(surface.view, halfway));
        highp vec3 specular = specularOfArea(surface, frame, area) * area.mirrored;
#if defined(HAS_NORMAL)
        specular = aboveHorizon(specular, shading_isBumped, direction);
#endif
        float diffuse = diffuseTerm(surface.nov, nol, voh, surface.perceptualRoughness);
        highp vec3 lobes =
                surface.diffuse * diffuseLeft(surface, direction, nol) * (diffuse * integral.z) * area.color + specular;
#if defined(HAS_SHEEN)
        if (hasSheen(surface.sheen)) {
            vec4 sheen = sheenOfLight(surface.sheen, surface.nov, nol, saturate(dot(surface.normal, halfway)));
#if defined(HAS_NORMAL)
            sheen.rgb = aboveHorizon(sheen.rgb, shading_isBumped, direction);
#endif
            lobes = lobes * sheen.w + sheen.rgb * integral.z * area.color;
        }
#endif
        reflected = lobes * area.luminance;
    }
#if defined(HAS_DIFFUSE_TRANSMISSION) || defined(REFRACTION_THIN)
    reflected += areaFromBehind(surface, frame, area);
#endif
#if defined(HAS_CLEAR_COAT)
    if (surface.coat.strength > 0.0) reflected = addCoatOfArea(surface, area, direction, reflected);
#endif
    return reflected;
}
