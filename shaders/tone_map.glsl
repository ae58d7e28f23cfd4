// Converts radiance to linear display values in [0, 1]. The rational function approximates the ACES reference and sRGB
// output transforms. It is Stephen Hill's fit, published in MJP's BakingLab, ACES.hlsl, 2016: from sRGB to a
// desaturated working space, through the curve, and back.
vec3 tone_map(vec3 radiance) {
  const mat3 in_matrix = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
  const mat3 out_matrix =
      mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
  vec3 v = in_matrix * radiance;
  v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
  return clamp(out_matrix * v, 0.0, 1.0);
}
