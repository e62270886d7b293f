# Lint: exit code 77 means that the tool is missing, which is a failure where PTB_STRICT is set.
function(ptbench_lint name)
  add_test(NAME lint.${name} COMMAND ${ARGN})
  set_tests_properties(lint.${name} PROPERTIES LABELS lint TIMEOUT 600 SKIP_RETURN_CODE 77)
endfunction()

set(lint ${PROJECT_SOURCE_DIR}/scripts/lint)
ptbench_lint(kernels ${lint}/kernels.sh)
ptbench_lint(format ${lint}/format.sh)
ptbench_lint(includes ${lint}/includes.sh)
ptbench_lint(scripts ${lint}/scripts.sh)
ptbench_lint(headers Python3::Interpreter -B ${lint}/headers_alone.py ${PROJECT_BINARY_DIR}/compile_commands.json)
set_tests_properties(lint.headers PROPERTIES LABELS "lint;long" COST 60 WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
