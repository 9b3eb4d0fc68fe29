// A vote as a widget of Jupyter.

import { askForVote } from "./lessons/voting.js";

export default { render: askForVote };
