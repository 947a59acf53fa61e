// Where rays enter the shell over the terrain: the distance from the eye. SWARD_SECOND: where they enter it again, behind
// what t_first has.
#if SWARD_SECOND
uniform sampler2D t_first;
#endif
in vec3 v_fromEye;
out float o_distance;

void main() {
  float distanceM = length(v_fromEye);
#if SWARD_SECOND
  float first = texelFetch(t_first, ivec2(gl_FragCoord.xy), 0).r;
  // The crest that a ray has just grazed is no second entry.
  if (first <= 0.0 || distanceM <= first * 1.01 + 1.0) discard;
#endif
  o_distance = distanceM;
}
