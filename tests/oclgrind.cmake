# Tiny renders under Oclgrind: each lane width with the scene in few spheres, and with a scene of many.
add_executable(render_once support/render_once_main.cpp support/scenes.cpp)
target_link_libraries(render_once PRIVATE ptbench_core ptbench_warnings)
target_compile_definitions(render_once PRIVATE PTB_SOURCE_DIR="${PROJECT_SOURCE_DIR}")

function(ptbench_oclgrind kernel lanes scene)
  string(REPLACE ";" "_" name "oclgrind.${kernel}_lanes${lanes}_${scene};${ARGN}")
  string(REGEX REPLACE "[:=]" "_" name ${name})
  add_test(NAME ${name} COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/render/oclgrind.sh $<TARGET_FILE:render_once> ${kernel}
                                ${lanes} ${scene} ${ARGN})
  set_tests_properties(${name} PROPERTIES LABELS oclgrind TIMEOUT 300 SKIP_RETURN_CODE 77)
endfunction()

ptbench_oclgrind(thesis 1 thesis)
foreach(lanes 1 4 16)
  ptbench_oclgrind(pt ${lanes} thesis)
  ptbench_oclgrind(pt ${lanes} balls:40)
  ptbench_oclgrind(pt_nee ${lanes} thesis)
  ptbench_oclgrind(pt_nee ${lanes} balls:40)
endforeach()
foreach(kernel whitted direct)
  ptbench_oclgrind(${kernel} 1 thesis)
  ptbench_oclgrind(${kernel} 4 balls:40)
endforeach()
ptbench_oclgrind(pt_nee 4 thesis roulette=albedo)
ptbench_oclgrind(bdpt 1 thesis)
ptbench_oclgrind(pt_lt 4 thesis)
ptbench_oclgrind(bdpt 4 thesis roulette=albedo)
ptbench_oclgrind(thesis 1 thesis queue=out_of_order dispatch=tasks)
ptbench_oclgrind(pt 1 thesis scene_memory=local rng=park_miller)
ptbench_oclgrind(pt 4 thesis scene_memory=private pixel_filter=stratified queue=out_of_order)
ptbench_oclgrind(pt 1 thesis dispatch=tasks build=strict)
ptbench_oclgrind(pt_nee 1 mesh_room bvh=bvh2)
ptbench_oclgrind(pt 1 mesh_room bvh=wide8)
ptbench_oclgrind(rays 1 mesh_room bvh=bvh2 ray_kind=shadow)
# Films in images are not watched: Oclgrind 21.10 takes what image functions return for uninitialised.

# What kernels count of themselves, against the instructions.
function(ptbench_oclgrind_counts kernel scene)
  string(REPLACE ":" "_" name oclgrind.counted_${kernel}_${scene})
  add_test(NAME ${name} COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/render/counted.py
                                $<TARGET_FILE:render_once> ${kernel} ${scene} ${ARGN})
  set_tests_properties(${name} PROPERTIES LABELS oclgrind TIMEOUT 300 SKIP_RETURN_CODE 77)
endfunction()

ptbench_oclgrind_counts(thesis thesis)
foreach(kernel pt pt_nee pt_lt direct whitted)
  ptbench_oclgrind_counts(${kernel} thesis)
  ptbench_oclgrind_counts(${kernel} balls:40)
endforeach()
ptbench_oclgrind_counts(bdpt thesis 4) # all pairs take their time
ptbench_oclgrind_counts(rays mesh_room 1 bvh=bvh2 ray_kind=bounce1)
ptbench_oclgrind_counts(pt far_apart)
ptbench_oclgrind_counts(pt at_a_wall)
ptbench_oclgrind_counts(pt_nee at_a_wall)
# In one work-group: Oclgrind 21.10 writes beyond its counts where a later one calls more functions than the first.
foreach(kernel pt pt_nee whitted)
  ptbench_oclgrind_counts(${kernel} mesh_room 4 bvh=bvh2 work_group=256)
endforeach()
