# Lint: exit code 77 means that the tool is missing, which is a failure where PTB_STRICT is set.
function(ptbench_lint name)
  add_test(NAME lint.${name} COMMAND ${ARGN})
  set_tests_properties(lint.${name} PROPERTIES LABELS lint TIMEOUT 600 SKIP_RETURN_CODE 77)
endfunction()

set(lint ${PROJECT_SOURCE_DIR}/scripts/lint)
ptbench_lint(kernels ${lint}/kernels.sh)
ptbench_lint(format ${lint}/format.sh)
ptbench_lint(includes ${lint}/includes.sh ${PROJECT_BINARY_DIR})
ptbench_lint(scripts ${lint}/scripts.sh)
set_tests_properties(lint.includes PROPERTIES COST 60)
