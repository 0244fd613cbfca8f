# SPDX-License-Identifier: BSD-3-Clause
# cmake -DINPUT=a.py -DNAME=symbol -DOUTPUT=a.cpp -P embed.cmake: a text file as a constant of C++.
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${bytes}")
file(WRITE ${OUTPUT} "extern \"C\" {\nextern const char ${NAME}[];\nconst char ${NAME}[] = {${bytes}'\\0'};\n}\n")
