# sward_embed_shaders(TARGET): compiles every file below shaders/ into TARGET as a table of name and text
# (core/render/shader_files.h declares it), so that the program needs no data folder at run time.
function(sward_embed_shaders target)
  file(GLOB_RECURSE shaders CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/shaders
    ${PROJECT_SOURCE_DIR}/shaders/*.glsl ${PROJECT_SOURCE_DIR}/shaders/*.vert
    ${PROJECT_SOURCE_DIR}/shaders/*.frag ${PROJECT_SOURCE_DIR}/shaders/*.comp)
  list(TRANSFORM shaders PREPEND ${PROJECT_SOURCE_DIR}/shaders/ OUTPUT_VARIABLE shader_paths)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/embedded_shaders.cpp)
  add_custom_command(OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DROOT=${PROJECT_SOURCE_DIR}/shaders "-DFILES=${shaders}"
            -P ${PROJECT_SOURCE_DIR}/cmake/EmbedShaders.cmake
    DEPENDS ${shader_paths} ${PROJECT_SOURCE_DIR}/cmake/EmbedShaders.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${out})
endfunction()
