// Reads a bag with the readers of others: @mcap/core takes the file apart by its indexes and holds
// its checksums, @foxglove/rosmsg2-serialization decodes every message by the definition in the
// file. Prints what is in it as JSON. Usage: node read_bag.mjs FILE (packages beside this script).
import { createHash } from "node:crypto";
import { open } from "node:fs/promises";

import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { decompress } from "fzstd";

const decompressHandlers = { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) };

class File {
  constructor(handle) { this.handle = handle; }
  async size() { return BigInt((await this.handle.stat()).size); }
  async read(offset, length) {
    const bytes = new Uint8Array(Number(length));
    await this.handle.read(bytes, 0, bytes.length, Number(offset));
    return bytes;
  }
}

const nanoseconds = (time) => BigInt(time.sec) * 1000000000n + BigInt(time.nanosec ?? time.nsec);
const digest = (bytes) => createHash("sha256").update(bytes).digest("hex");

/// What a test wants to know of one message.
function summary(type, message) {
  const stamp = message.header ? nanoseconds(message.header.stamp).toString() : undefined;
  const frame = message.header?.frame_id;
  if (type.endsWith("/Image")) {
    return { stamp, frame, width: message.width, height: message.height, step: message.step,
             encoding: message.encoding, data: digest(message.data) };
  }
  if (type.endsWith("/CameraInfo")) {
    return { stamp, frame, model: message.distortion_model, d: [...message.d], k: [...message.k],
             r: [...message.r], p: [...message.p], width: message.width, height: message.height };
  }
  if (type.endsWith("/Odometry")) {
    return { stamp, frame, child: message.child_frame_id, pose: message.pose.pose,
             covariance: [...message.pose.covariance], twist: message.twist.twist,
             twist_covariance: [...message.twist.covariance] };
  }
  if (type.endsWith("/PoseStamped")) return { stamp, frame, pose: message.pose };
  if (type.endsWith("/Path")) {
    return { frame, stamps: message.poses.map((p) => nanoseconds(p.header.stamp).toString()) };
  }
  if (type.endsWith("/TFMessage")) {
    return message.transforms.map((t) => ({ parent: t.header.frame_id, child: t.child_frame_id,
      stamp: nanoseconds(t.header.stamp).toString(), transform: t.transform }));
  }
  if (type.endsWith("/MarkerArray")) {
    return message.markers.map((m) => ({ action: m.action, type: m.type, scale: m.scale, text: m.text }));
  }
  if (type.endsWith("/ImageMarker")) return { stamp, frame, points: message.points.length };
  if (type.endsWith("/Log")) return { level: message.level, text: message.msg };
  return message;
}

const handle = await open(process.argv[2]);
const reader = await McapIndexedReader.Initialize({ readable: new File(handle), decompressHandlers });
const result = { profile: reader.header.profile, topics: {}, metadata: {}, attachments: [] };
const decoders = new Map();
for (const channel of reader.channelsById.values()) {
  const schema = reader.schemasById.get(channel.schemaId);
  const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
  decoders.set(channel.id, new MessageReader(definition));
  result.topics[channel.topic] = { type: schema.name, encoding: channel.messageEncoding,
    schema: schema.encoding, qos: channel.metadata.get("offered_qos_profiles"), messages: [] };
}
let last = 0n;
for await (const message of reader.readMessages()) {
  if (message.logTime < last) throw new Error("log times fall in an indexed read");
  last = message.logTime;
  const channel = reader.channelsById.get(message.channelId);
  const topic = result.topics[channel.topic];
  const decoded = decoders.get(channel.id).readMessage(message.data);
  topic.messages.push({ log: message.logTime.toString(), ...{ value: summary(topic.type, decoded) } });
}
for await (const record of reader.readMetadata()) {
  result.metadata[record.name] = Object.fromEntries(record.metadata);
}
for await (const record of reader.readAttachments()) {
  result.attachments.push({ name: record.name, bytes: record.data.length });
}
result.counted = Number(reader.statistics.messageCount);

// Once more from front to back, which checks what an indexed read leaves out: the data's checksum.
const whole = new McapStreamReader({ decompressHandlers, validateCrcs: true });
whole.append(new Uint8Array(await new File(handle).read(0n, await new File(handle).size())));
result.streamed = 0;
for (let record = whole.nextRecord(); record; record = whole.nextRecord()) {
  if (record.type === "Message") ++result.streamed;
}
result.done = whole.done();
console.log(JSON.stringify(result, (key, value) => (typeof value === "bigint" ? value.toString() : value)));
