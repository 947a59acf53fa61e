// The yardstick of the march: as many nearest fetches a pixel as the slices have layers, each from its own plane at the
// pixel's own place, summed. No light, no filter, no blending.
uniform usamplerBuffer t_texels;
uniform int u_fetches;
uniform int u_side;   // texels of a square plane
out vec4 o_sum;

void main() {
  ivec2 place = ivec2(gl_FragCoord.xy) % u_side;
  int within = place.y * u_side + place.x;
  uint sum = 0u;
  for (int i = 0; i < u_fetches; ++i) sum += texelFetch(t_texels, i * u_side * u_side + within).r;
  o_sum = vec4(float(sum & 0xffffu));
}
