#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# doxygen_group.sh HEADER: the header, all of it in the group of its folder. Lines keep their numbers.
folder=${1#*include/scree/}
printf '/** @folder{%s} */ ' "${folder%%[/.]*}"
cat -- "$1"
printf '/** @} */\n'
