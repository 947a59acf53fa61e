# One static library per folder of core/. A folder may use only the targets named in DEPENDS, so an include against the
# direction of the architecture does not link; tests/layout also reads the include lines themselves.

add_library(sward_compile_options INTERFACE)
target_compile_options(sward_compile_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-align -Woverloaded-virtual
  -Wnull-dereference -Wimplicit-fallthrough -Wextra-semi -Wundef
  # GCC 12 sees overlap in `"text" + std::string()` at -O3 that is not there (GCC bug 105651).
  -Wno-restrict
  # IEEE semantics on purpose: no -ffast-math, and no contraction, so that a fused multiply-add never changes a baked byte.
  -ffp-contract=off)
if(SWARD_WERROR)
  target_compile_options(sward_compile_options INTERFACE -Werror)
endif()
if(SWARD_SANITIZE)
  target_compile_options(sward_compile_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(sward_compile_options INTERFACE -fsanitize=address,undefined)
endif()

# sward_library(NAME [DEPENDS folders of core ...] [LIBRARIES imported targets ...] [PRIVATE_LIBRARIES ...])
# Builds sward_NAME from every .cpp of the current folder.
function(sward_library name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(sward_${name} STATIC ${sources})
  target_include_directories(sward_${name} PUBLIC ${PROJECT_SOURCE_DIR}/core)
  list(TRANSFORM ARG_DEPENDS PREPEND sward_)
  target_link_libraries(sward_${name}
    PUBLIC ${ARG_DEPENDS} ${ARG_LIBRARIES}
    PRIVATE sward_compile_options ${ARG_PRIVATE_LIBRARIES})
endfunction()

# sward_editor_library(NAME [DEPENDS folders of editor ...] [CORE folders of core ...] [LIBRARIES ...] [PRIVATE_LIBRARIES ...])
# The same for a folder of editor/: builds sward_editor_NAME, includes start at editor/ or core/.
function(sward_editor_library name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;CORE;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(sward_editor_${name} STATIC ${sources})
  target_include_directories(sward_editor_${name} PUBLIC ${PROJECT_SOURCE_DIR}/editor)
  list(TRANSFORM ARG_DEPENDS PREPEND sward_editor_)
  list(TRANSFORM ARG_CORE PREPEND sward_)
  target_link_libraries(sward_editor_${name}
    PUBLIC ${ARG_DEPENDS} ${ARG_CORE} ${ARG_LIBRARIES}
    PRIVATE sward_compile_options ${ARG_PRIVATE_LIBRARIES})
endfunction()

# sward_test(NAME [DEPENDS folders of core ...] [LIBRARIES ...])
# SERIAL: no other test runs beside it. Builds test_NAME from every .cpp of the current folder and registers each of its GoogleTest cases with CTest.
function(sward_test name)
  cmake_parse_arguments(ARG "SERIAL" "TIMEOUT" "DEPENDS;LIBRARIES" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_executable(test_${name} ${sources})
  list(TRANSFORM ARG_DEPENDS PREPEND sward_)
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(test_${name} PRIVATE sward_compile_options ${ARG_DEPENDS} ${ARG_LIBRARIES} third_party::gtest)
  target_compile_definitions(test_${name} PRIVATE
    SWARD_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    SWARD_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared"
    SWARD_BINARY="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/sward")
  gtest_discover_tests(test_${name} TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT ${ARG_TIMEOUT} RUN_SERIAL ${ARG_SERIAL})
endfunction()
