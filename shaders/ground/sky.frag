#include "ground/constants.glsl"
#include "ground/view.glsl"
#include "ground/sky.glsl"

uniform float u_exposure;
out vec4 o_radiance;

void main() {
  vec3 d = viewRay(gl_FragCoord.xy);
  o_radiance = vec4((skyRadiance(d) + sunDisc(d)) * u_exposure, 1.0);
}
