// The terrain's levels of detail, lifted by the shell's height: vertices relative to the eye from a buffer.
uniform samplerBuffer t_vertices;  // RGB32F
uniform vec3 u_right;              // over the tangents of half the field of view
uniform vec3 u_up;
uniform vec3 u_forward;
uniform vec2 u_jitter;             // of the sample, in [-1, 1] over the picture
uniform float u_liftM;
uniform float u_nearM;
out vec3 v_fromEye;

void main() {
  v_fromEye = texelFetch(t_vertices, gl_VertexID).xyz + vec3(0.0, 0.0, u_liftM);
  float ahead = dot(v_fromEye, u_forward);
  vec2 picture = vec2(dot(v_fromEye, u_right), dot(v_fromEye, u_up));
  // Depth near / distance, 1 to 0: floats keep it equally precise at all distances.
  gl_Position = vec4(picture - u_jitter * ahead, u_nearM, ahead);
}
