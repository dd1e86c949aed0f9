#!/bin/sh
# describe.sh PROGRAM FOLDER VERSION [HELP2MAN]: completion and, with help2man, manual pages of the
# program and of each of its commands.
set -eu
program=$1 folder=$2 version=$3 help2man=${4:-}
mkdir -p "$folder/man1"
"$program" completion bash >"$folder/aisle.bash.new"
if [ -n "$help2man" ]; then
  page() {  # page NAME COMMAND...
    name=$1
    shift
    about=$("$@" --help | sed -n '1s/ *$//p' | sed 's/^aisle: //')
    SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-0} "$help2man" --no-info --section 1 --manual aisle \
      --source "aisle $version" --version-string "$version" --name "$about" "$*" |
      sed "s/^aisle ${2:-} \\\\- /$name \\\\- /" |  # as whatis looks for it
      gzip -9n >"$folder/man1/$name.1.gz"
  }
  page aisle "$program"
  for command in $("$program" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]*\) .*/\1/p'); do
    page "aisle-$command" "$program" "$command"
  done
fi
mv "$folder/aisle.bash.new" "$folder/aisle.bash"
