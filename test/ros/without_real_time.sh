#!/bin/sh
# Runs a program that is granted no real-time priority, whoever runs it: without_real_time.sh PROGRAM [ARGUMENT...]
if [ "$(id -u)" = 0 ]; then
  exec setpriv --bounding-set=-sys_nice --inh-caps=-sys_nice prlimit --rtprio=0 "$@"
fi
exec prlimit --rtprio=0 "$@"
