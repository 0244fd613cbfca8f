#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Every shipped binary is hardened: position independent, read-only relocations bound at load, no executable stack, stack protector,
# fortified functions.   hardening.sh [BUILD]
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}
bad=0
complain() { echo "$1: $2"; bad=1; }

protected=0 fortified=0
for file in "$build"/bin/fulmar "$build"/bin/fulmar-probe "$build"/bin/fulmar-child "$build"/bin/fulmar-{campaign,inspect,live,log,new,replay,report,save} "$build"/bin/fulmar-{fcu,aero,import,ros2} "$build"/lib/fulmar/*.so "$build"/lib/fulmar/host/*.so; do
  [ -e "$file" ] || continue
  readelf -hW "$file" | grep -qE 'Type: +DYN' || complain "$file" "not position independent"
  readelf -lW "$file" | grep -q GNU_RELRO || complain "$file" "relocations stay writable (no relro)"
  readelf -dW "$file" | grep -qE 'BIND_NOW|FLAGS.*NOW' || complain "$file" "symbols are bound when they are first called (no now)"
  readelf -lW "$file" | grep GNU_STACK | grep -q 'RWE' && complain "$file" "the stack is executable"
  symbols=$(readelf --dyn-syms -W "$file")
  if grep -q '__stack_chk_fail' <<<"$symbols"; then
    protected=$((protected + 1))
  elif [[ $file == */bin/* ]]; then
    complain "$file" "no stack protector"
  fi
  if grep -qE '__[a-z]+_chk(@|$)' <<<"$symbols"; then fortified=$((fortified + 1)); fi
done
grep -qE '__[a-z]+_chk(@|$)' <<<"$(readelf --dyn-syms -W "$build/bin/fulmar")" || complain "$build/bin/fulmar" "no fortified function"
[ "$bad" -eq 0 ] && echo "every shipped binary is hardened; $protected have protected stacks, $fortified call fortified functions"
exit $bad
