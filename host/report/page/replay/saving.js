// SPDX-License-Identifier: MIT
// saving.js: buttons that save the present picture as PNG, the replay as a video and the curves as SVG.
import {element} from '../elements.js';
import {download, file_name, save_svg} from '../svg_files.js';

const FRAMES_A_SECOND = 30;
const BITS_A_SECOND = 6e6;
// The first that the browser offers is taken.
const KINDS = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm', 'video/mp4'];
const NO_RECORDER = 'This browser cannot record videos. dmrp-host video RUN_DIR --trial K --out FILE.mp4 makes one.';

function button(text, label, id, pressed) {
  return element(
    'button',
    {type: 'button', class: 'button small', title: label, 'data-testid': `replay-save-${id}`, onclick: pressed},
    text
  );
}

// player: picture() draws and returns the canvas that is seen, curves(): their element, trial(): the shown trial,
// say(text).
export function make_saving(clock, player) {
  const picture_button = button('picture', 'save this picture as PNG', 'picture', save_picture);
  const video_button = button('video', 'record the trial from its beginning as WebM', 'video', toggle_video);
  const curves_button = button('curves', 'save the curves as SVG', 'curves', () =>
    save_svg(player.curves(), ['trial', player.trial(), 'curves'])
  );
  let recorder = null;

  function save_picture() {
    const name = file_name(['trial', player.trial(), `${clock.t.toFixed(1)}s`], 'png');
    player.picture().toBlob((blob) => download(blob, name), 'image/png');
  }

  function show_recording() {
    video_button.textContent = recorder ? 'stop' : 'video';
    video_button.setAttribute('aria-pressed', String(recorder !== null));
  }

  function stop() {
    if (recorder && recorder.state !== 'inactive') recorder.stop();
  }

  function record(kind) {
    const name = file_name(['trial', player.trial()], kind.split(/[/;]/)[1]);
    const canvas = player.picture();
    const stream = canvas.captureStream(FRAMES_A_SECOND);
    const parts = [];
    recorder = new MediaRecorder(stream, {mimeType: kind, videoBitsPerSecond: BITS_A_SECOND});
    recorder.ondataavailable = (event) => event.data.size > 0 && parts.push(event.data);
    recorder.onstop = () => {
      stream.getTracks().forEach((track) => track.stop());
      recorder = null;
      show_recording();
      clock.pause();
      download(new Blob(parts, {type: kind}), name);
    };
    recorder.start();
    clock.go(0);
    clock.play();
    show_recording();
  }

  // Records at the chosen speed until the end, until pause, or until the button is pressed again.
  function toggle_video() {
    if (recorder) {
      stop();
      return;
    }
    const kind = window.MediaRecorder && KINDS.find((one) => MediaRecorder.isTypeSupported(one));
    if (kind) record(kind);
    else player.say(NO_RECORDER);
  }

  clock.on_change(() => {
    if (recorder && !clock.playing && clock.t > 0) stop();
  });

  return {
    node: element(
      'div',
      {class: 'control replay-saving'},
      element('span', {}, 'save'),
      picture_button,
      video_button,
      curves_button
    ),
    stop,
  };
}
