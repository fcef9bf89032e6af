#!/usr/bin/env bash
# small-mcap 0.16.0: messages come back in the order of their times backwards, and forwards in the order in which they were written.
#
# A recorder that hears of poses over a network writes some of them late; MCAP keeps the log time of every message for this. read_message with
# reverse=True gives them by falling log time, as its docstring promises, late ones too. Forwards, of which it says nothing, it sorts whole chunks
# and channels only: three poses written at 3, 1 and 2 s come back as 3, 1, 2. Merged by the same function with a second file, whose pose is of
# 1.5 s, they come back as 1.5, 3, 1, 2. Nothing is lost, but a replay that takes each message for the newest one jumps back.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --disable-pip-version-check --root-user-action ignore --target "$folder/packages" small-mcap==0.16.0
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import io
import sys
import small_mcap

SECOND = 1_000_000_000


def written(*seconds):
    file = io.BytesIO()
    writer = small_mcap.McapWriter(file, compression=small_mcap.CompressionType.NONE)
    writer.start()
    writer.add_channel(channel_id=1, topic="/pose", message_encoding="json", schema_id=0)
    for second in seconds:
        time = int(second * SECOND)
        writer.add_message(channel_id=1, log_time=time, data=b"{}", publish_time=time)
    writer.finish()
    return file.getvalue()


late, other = written(3, 1, 2), written(1.5)


def read(source, **options):
    return [message.log_time / SECOND for _, _, message in small_mcap.read_message(source, **options)]


forwards, backwards = read(io.BytesIO(late)), read(io.BytesIO(late), reverse=True)
merged = read([io.BytesIO(late), io.BytesIO(other)])
print("written at 3, 1, 2 s: forwards", forwards, "- backwards", backwards, "- with a second file at 1.5 s", merged)
print("small-mcap", importlib.metadata.version("small-mcap"))
sys.exit(not (forwards == [3, 1, 2] and backwards == [3, 2, 1] and merged == [1.5, 3, 1, 2]))
PYTHON
PYTHONPATH="$folder/packages" python3 "$folder/try.py"
