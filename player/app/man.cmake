# cmake -DPROGRAM=FILE -DNAME=NAME -DOUTPUT=FILE -P man.cmake: a manual page of what --help-all says.
set(HELP --help-all)
if(NAME STREQUAL oriel-inspect)
  set(HELP --help)  # it has none that are rare
endif()
execute_process(COMMAND ${PROGRAM} ${HELP} OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "^[^\n]*" summary "${help}")
string(REPLACE "\\" "\\e" help "${help}")
string(REPLACE "-" "\\-" help "${help}")
string(REGEX REPLACE "(^|\n)([.'])" "\\1\\\\&\\2" help "${help}")
string(TOUPPER ${NAME} title)
file(WRITE ${OUTPUT} ".TH ${title} 1\n.SH NAME\n${NAME} \\- ${summary}\n.SH DESCRIPTION\n.nf\n${help}.fi\n")
