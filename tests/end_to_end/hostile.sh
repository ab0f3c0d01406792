#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Attacks of a plugin on its worker, its supervisor and other workers end in a fault that names the plugin, or do nothing.
# Other trials have the values of a run without it, and nothing is left behind.
# Called as: hostile.sh DMRP_HOST LIBRARY_OF_ATTACKS [SANITIZERS]
source "$(dirname "${BASH_SOURCE[0]}")/faults.sh"

export DMRP_TEST_OUTSIDE=$scratch/outside

# begin NAME: the crossing with one planner and the controller whose values are compared
begin() {
  begin_experiment "$1" local_controller global_planner
  use "$1" metric dmrp.metric.success
  use "$1" metric dmrp.metric.path_length
  use "$1" global_planner dmrp.planner.cbs
  use "$1" local_controller dmrp.controller.pure_pursuit
  echo 'label = "pursuit"' >>"$scratch/$1.toml"
  sed -i 's/^trials .*/trials = 2/' "$scratch/$1.toml"
}
hostile() {
  printf '\n[[local_controller]]\nuse = "test.controller.hostile"\nlabel = "%s"\nparams = { attack = "%s" }\n' "$2" "$2" \
    >>"$scratch/$1.toml"
}
values() {
  query "$1" "SELECT trial.repetition, outcome, repeatable, metric, subject_kind, subject, printf('%!.17g', value.value)
    FROM value JOIN trial ON trial.id = trial_id WHERE local_controller = 'pursuit' ORDER BY 1, 4, 5, 6"
}
# note WHERE ATTACK END [NAMED]: an attack for docs/attacks.md, which is compared with what was tested here; attacks that
# differ in nothing else share a row
declare -A table=()
rows=()
note() {
  local row="$1 | $3 | ${4:-nothing to name}"
  [[ -n ${table[$row]:-} ]] || rows+=("$row")
  table[$row]+="${table[$row]:+; }$2"
}
note_all() {
  local row attack kind
  for row in "${@:2}"; do
    IFS='|' read -r attack kind _ <<<"$row"
    note "$1" "$attack" "fault, \`$kind\`" yes
  done
}
# expect_none_left PATTERN: a process that was killed may need a moment to be gone
expect_none_left() {
  local deadline=$((SECONDS + 30))
  while pgrep -f "$1" >/dev/null; do
    ((SECONDS < deadline)) || fail "processes are left: $(pgrep -af "$1")"
    sleep 0.1
  done
}
expect_same() {
  [[ $(values "$scratch/$1") == "$(values "$scratch/alone")" ]] || fail "$1: attacks change the values of others"
}

# take the 20 s that a library may take to load; what comes of it is looked at further below
declare -A waiting=()
for what in wait close; do
  cp "$library" "$scratch/$what.so"
  DMRP_TEST_AT_LOAD="$what" "$host" plugins "$scratch/$what.so" >"$scratch/$what.stdout" 2>"$scratch/$what.stderr" &
  waiting[$what]=$!
done

begin alone
run_with_faults alone 0
[[ -n $(values "$scratch/alone") ]] || fail "there should be values to compare"

# all in one run: attack|kind|function|detail
attacks=(
  'fork and return|abi_breach|step|process behind'
  'fork and stay|abi_breach|step|process behind'
  'clone and return|abi_breach|step|process behind'
  'kills itself|crash|step|SIGKILL'
  'traps numbers|abi_breach|step|floating-point control'
  'late thread|crash|.*|Segmentation fault'
  'burns processors|hang|step|'
)
# sanitizers answer to a wrong access themselves
if $limited; then
  attacks+=(
    'writes into the observation|abi_breach|step|wrote into what it may only read'
    'writes into the world|abi_breach|step|wrote into what it may only read'
  )
fi
# there is nothing of the host in the guest that they reach
unreachable=("forged end" "forged error" "no message" "oversized message" "closed channel" "closed trace"
  "all closed" "files limited")
# without a box it can write where the user can
unnamed=('deletes its files|worker_error||trace was deleted or replaced'
  'replaces its trace|worker_error||trace was deleted or replaced')
# expect_faults NAME PLUGIN ROW...
expect_faults() {
  local row attack kind function detail found
  for row in "${@:3}"; do
    IFS='|' read -r attack kind function detail <<<"$row"
    found=$(query "$scratch/$1" "SELECT kind, function, detail FROM fault JOIN trial ON trial.id = trial_id
      WHERE local_controller = '$attack' AND plugin = '$2' ORDER BY trial_id LIMIT 1")
    grep -Eq "^$kind\|$function\|.*$detail" <<<"$found" ||
      fail "$attack: '$found' does not match $kind, $function, $detail"
  done
}
begin attacks
for row in "${attacks[@]}" "${unreachable[@]}" "${unnamed[@]}"; do hostile attacks "${row%%|*}"; done
run_with_faults attacks 1 --no-box
expect_faults attacks test.controller.hostile "${attacks[@]}"
expect_faults attacks "" "${unnamed[@]}"
[[ $(query "$scratch/attacks" "SELECT count(*) FROM trial WHERE outcome = 'fault'") == \
  $((2 * (${#attacks[@]} + ${#unnamed[@]}))) ]] ||
  fail "the others should do nothing: $(query "$scratch/attacks" "SELECT local_controller, outcome FROM trial")"
expect_same attacks
note_all "no box" "${attacks[@]}"
for attack in "${unreachable[@]}"; do note "no box" "$attack" "nothing"; done
for row in "${unnamed[@]}"; do note "no box" "${row%%|*}" "fault, \`worker_error\`" no; done

# in the box, the system call is named
boxed=(
  "fork and return|abi_breach|step|refuses fork"
  "clone and return|abi_breach|step|refuses fork"
  "runs a program|abi_breach|step|system\(\) or popen"
  "replaces itself|abi_breach|step|refuses execve"
  "stops its parent|abi_breach|step|refuses kill"
  "ends its parent|abi_breach|step|refuses kill"
  "outlives its parent|abi_breach|step|refuses prctl"
  "lets others look in|abi_breach|step|refuses prctl"
  "traces its parent|abi_breach|step|refuses ptrace"
  "kills siblings|abi_breach|step|refuses kill"
)
begin boxed
for row in "${boxed[@]}"; do hostile boxed "${row%%|*}"; done
for attack in none threads "files limited"; do hostile boxed "$attack"; done
if $limited; then # the box and sanitizers exclude each other
  run_with_faults boxed 1
  expect_faults boxed test.controller.hostile "${boxed[@]}"
  [[ $(query "$scratch/boxed" "SELECT count(*) FROM trial WHERE outcome <> 'fault'
    AND local_controller IN ('none', 'threads', 'files limited')") == 6 ]] || fail "threads may be used in the box"
  expect_same boxed
  note_all box "${boxed[@]}"
  note box threads "nothing"
fi

# it sees nothing of the user's: a kernel without namespaces has these attacks succeed, and says so
no_namespaces=(env "DMRP_VIEW=namespaces: none in this test")
has_namespaces=true
"$host" "$here/crossing.toml" --trials 1 --out "$scratch/seen" >/dev/null 2>"$scratch/stderr"
if grep -q "plugins can read and change your files, and reach the network (namespaces: " "$scratch/stderr"; then
  echo "not tested: the kernel refuses namespaces"
  has_namespaces=false
fi
unseen=("writes elsewhere" "reads elsewhere" "falsifies databases" "deletes traces" "reaches a network" "fills the disk"
  "slows others down")
begin open
hostile open "writes elsewhere"
hostile open "reads elsewhere"
hostile open "reaches a network"
expect_status 1 "${no_namespaces[@]}" "$host" "$scratch/open.toml" --out "$scratch/open"
! $limited || [[ $(grep -c "reach the network (namespaces: none in this test): allow user namespaces" "$scratch/stderr") == 1 ]] ||
  fail "$(cat "$scratch/stderr")"
[[ -e $scratch/outside ]] || fail "without namespaces it should write"
[[ $(query "$scratch/open" "SELECT count(*) FROM fault WHERE kind = 'crash'") == 4 ]] || fail "it should see and reach"
if $limited && $has_namespaces; then
  rm "$scratch/outside"
  begin unseen
  for attack in none threads "${unseen[@]}"; do hostile unseen "$attack"; done
  run_with_faults unseen 0
  expect_same unseen
  expect_status 0 env DMRP_TEST_AT_LOAD=write "$host" plugins "$library"
  [[ ! -e $scratch/outside ]] || fail "a plugin has written where it should see nothing"
  [[ $(find "$scratch/unseen/traces" -name "*.mcap" | wc -l) == 20 ]] || fail "traces were deleted"
  for attack in "${unseen[@]}"; do note box "$attack" "nothing to see"; done
  begin visible
  hostile visible "reads elsewhere"
  sed -i "/^memory_mb/a visible = [\"$scratch\"]" "$scratch/visible.toml"
  run_with_faults visible 1
fi

# a debugger stops where a plugin writes into what it may only read
if $limited; then
  begin debugged
  hostile debugged "writes into the world"
  expect_status 139 "$host" "$scratch/debugged.toml" --debug 1
fi

# what reaches others by a way around those calls fails; it has a terminal here, into which it could type
reaching=("looks into others" "sends signals by a file" "types into the terminal" "asks for rings and segments")
if $limited; then
  begin reaching
  for attack in "${reaching[@]}"; do hostile reaching "$attack"; done
  expect_status 0 script -qec "'$host' '$scratch/reaching.toml' --quiet --jobs 2 --out '$scratch/reaching'" /dev/null
  [[ ! -s $scratch/stdout ]] || fail "nothing should be said: $(cat "$scratch/stdout")"
  expect_same reaching
  for attack in "${reaching[@]}"; do note box "$attack" "refused with an error"; done
fi

# under the names of traces and plans that are still to be made
begin planted
for attack in "plants pipes" "plants links"; do hostile planted "$attack"; done
echo kept >"$scratch/outside"
expect_status 0 "${no_namespaces[@]}" "$host" "$scratch/planted.toml" --quiet --out "$scratch/planted"
[[ $(<"$scratch/outside") == kept ]] || fail "a file outside has been changed by a link"
[[ -z $(find "$scratch/planted" ! -type f ! -type d) ]] || fail "planted files are left"
expect_same planted
for attack in "plants pipes" "plants links"; do note "no namespaces" "$attack" "replaced by files"; done

# in a run directory of somebody else
ln -sf "$scratch/outside" "$scratch/planted/log.txt"
expect_status 2 "${no_namespaces[@]}" "$host" "$scratch/planted.toml" --quiet --resume --trials 3 --out "$scratch/planted"
grep -q "planted/log.txt: is no regular file" "$scratch/stderr" || fail "$(cat "$scratch/stderr")"
mkfifo "$scratch/pipe"
for planted in outside pipe; do
  ln -sf "$scratch/$planted" "$scratch/planted/traces/trial_000000.mcap"
  status=0
  timeout 60 "$host" evaluate "$scratch/planted" --trial 0 >"$scratch/stdout" 2>"$scratch/stderr" || status=$?
  ((status > 0 && status < 100)) || fail "$planted: exit status $status"
  grep -Eq "trial_000000.mcap( was changed after the run| is missing)" "$scratch/stderr" || fail "$(cat "$scratch/stderr")"
done
[[ $(<"$scratch/outside") == kept ]] || fail "a file outside has been changed by a link"

# faults that were a plugin's are tried again on demand
faulty() { query "$scratch/attacks" "SELECT DISTINCT trial_id FROM fault ORDER BY 1"; }
before=$(faulty)
expect_status 1 "$host" "$scratch/attacks.toml" --no-box --quiet --resume --out "$scratch/attacks"
expect_status 2 "$host" "$scratch/attacks.toml" --quiet --retry-faults --out "$scratch/attacks"
expect_status 1 "$host" "$scratch/attacks.toml" --no-box --quiet --resume --retry-faults --out "$scratch/attacks"
[[ -n $before && $(faulty) == "$before" ]] || fail "--retry-faults should find them again"
expect_same attacks

# stored traces that a plugin deletes are gone, no values are
begin vanish
hostile vanish "deletes traces"
expect_status 0 "${no_namespaces[@]}" "$host" "$scratch/vanish.toml" --quiet --out "$scratch/vanish"
grep -q "vanish/traces: was deleted, with the traces of earlier trials" "$scratch/vanish/log.txt" ||
  fail "log.txt should say that traces are gone"
expect_same vanish
note "no namespaces" "deletes traces" "traces are gone, a line says so"

# destroy() is called when the trials are over
begin destroy
hostile destroy "crash in destroy"
run_with_faults destroy 1
[[ $(query "$scratch/destroy" "SELECT kind, plugin, function, signal, local_controller FROM fault
  JOIN trial ON trial.id = trial_id LIMIT 1") == "crash|test.controller.hostile|destroy|11|"* ]] ||
  fail "a crash in destroy() should be a fault: $(query "$scratch/destroy" "SELECT * FROM fault")"
expect_same destroy
note box "crash in destroy" "fault, \`crash\`" yes

# what plugins print has an end
begin loud
hostile loud "prints much"
run_with_faults loud 0
(($(stat -c %s "$scratch/loud/log.txt") < 40000000)) || fail "log.txt has $(stat -c %s "$scratch/loud/log.txt") bytes"
grep -q "what follows is left out" "$scratch/loud/log.txt" || fail "log.txt should say that lines are left out"
expect_same loud
note box "prints much" "the log ends at 16 MB"

# a plugin that says that it starts processes has a namespace for them, in which it can kill them all
begin helped
helping=("runs a program" "fork and return" "fork and stay" "kills everything" "kills its group")
for attack in "${helping[@]}"; do hostile helped "$attack"; done
sed -i 's/test.controller.hostile/test.controller.helped/' "$scratch/helped.toml"
if $limited; then
  expect_status 2 "${no_namespaces[@]}" "$host" "$scratch/helped.toml" --quiet --out "$scratch/helped"
  grep -q "test.controller.helped starts processes, which need namespaces (namespaces: none in this test): see --no-box" \
    "$scratch/stderr" || fail "$(cat "$scratch/stderr")"
fi
if $limited && $has_namespaces; then
  run_with_faults helped 1
  tr -d ' \n' <"$scratch/helped/manifest.json" | grep -q '"plugins_with_processes":\["test.controller.helped"\]' ||
    fail "the manifest should name the plugin: $(cat "$scratch/helped/manifest.json")"
  expect_same helped
  [[ $(query "$scratch/helped" "SELECT DISTINCT local_controller, kind, plugin FROM fault JOIN trial ON trial.id = trial_id") == \
    "kills its group|crash|test.controller.helped" ]] || fail "$(query "$scratch/helped" "SELECT * FROM fault")"
  for attack in "${helping[@]::4}"; do note box "says that it starts processes: $attack" "nothing outside of its namespace"; done
  note box "says that it starts processes: kills its group" "fault, \`crash\`" yes
fi

# shared memory, which no limit on data counts, is watched; so is all memory of a plugin that asks for it
if $limited; then
  begin shared
  hostile shared fills
  sed -i 's/^memory_mb .*/memory_mb = 150/' "$scratch/shared.toml"
  run_with_faults shared 1
  expect_fault shared "local_controller = 'fills' AND repetition = 0" \
    "out_of_memory|test.controller.hostile|step|50|1|" "more than memory_mb = 150( in use)?; when this"
  expect_same shared
  note box "fills shared memory" "fault, \`out_of_memory\`" yes
  begin resident
  hostile resident fills
  sed -i 's/test.controller.hostile/test.controller.resident/; s/^memory_mb .*/memory_mb = 150/' "$scratch/resident.toml"
  run_with_faults resident 1
  expect_fault resident "local_controller = 'fills' AND repetition = 0" \
    "out_of_memory|test.controller.resident|step|50|1|" "more than memory_mb = 150( in use)?; when this is noticed"
  expect_same resident
  note box "fills memory, watched" "fault, \`out_of_memory\`" yes
  if $has_namespaces; then
    begin two
    hostile two "two fill"
    sed -i 's/test.controller.hostile/test.controller.helped/; s/^memory_mb .*/memory_mb = 150/' "$scratch/two.toml"
    run_with_faults two 1
    expect_fault two "local_controller = 'two fill' AND repetition = 0" \
      "out_of_memory|test.controller.helped|step|50|1|" "MB in use, more than memory_mb = 150; when this is noticed"
    expect_same two
    note box "says that it starts processes: fills memory in two" "fault, \`out_of_memory\`" yes
  fi
fi

# what a library does while it is loaded
cp "$library" "$scratch/at_load.so"
at_load() { DMRP_TEST_AT_LOAD=$1 timeout 120 "$host" plugins "$scratch/at_load.so"; }
expect_status 0 at_load none
grep -q test.controller.hostile "$scratch/stdout" || fail "the plugin should be listed"
for what in fork stay; do
  attack="while loaded: fork and $([[ $what == fork ]] && echo return || echo stay)"
  if $limited; then
    expect_status 2 at_load $what
    grep -q "makes a system call while it is loaded, in dlopen, that the box refuses" "$scratch/stderr" ||
      fail "$(cat "$scratch/stderr")"
    note probe "$attack" "refused before the run" "the library"
  else
    expect_status 0 at_load $what
  fi
done
for what in wait close; do
  status=0
  wait "${waiting[$what]}" || status=$?
  ((status == 2)) || fail "exit status $status, not 2: $(cat "$scratch/$what.stderr")"
  grep -q "$what.so: hangs while it is loaded, in dlopen" "$scratch/$what.stderr" || fail "$(cat "$scratch/$what.stderr")"
  expect_none_left "plugins $scratch/$what.so"
done
note probe "while loaded: waits" "refused before the run" "the library"
note probe "while loaded: closes its pipes, blocks all signals" "refused before the run" "the library"

# attacks that do nothing, or leave no trace in the results
begin harmless
harmless=(threads reserves umask "all descriptors taken" "kills siblings" "quiet heap corruption")
for attack in none "${harmless[@]}"; do hostile harmless "$attack"; done
status=0
"$host" "$scratch/harmless.toml" --no-box --quiet --jobs 2 --out "$scratch/harmless" || status=$?
((status <= 1)) || fail "exit status $status"
expect_same harmless

expect_none_left "worker $scratch/"
! compgen -G "$scratch/*/scratch*" >/dev/null || fail "scratch files are left"
# what a plugin does to the mask of new files changes none of the run's
[[ -z $(find "$scratch/harmless/traces" ! -perm -0444) ]] || fail "traces should be readable"
for attack in "${harmless[@]}"; do note "no box" "$attack" "no wrong value"; done

# the table for readers has what was tested, no more and no less
if $limited && $has_namespaces; then
  diff <(for row in "${rows[@]}"; do echo "| ${table[$row]} | $row |"; done) \
    <(grep '^| ' "$here/../../docs/attacks.md" | tail -n +3) ||
    fail "docs/attacks.md: its rows should be those with '<'"
fi
